// python
