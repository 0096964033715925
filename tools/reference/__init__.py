"""Pages of reference, one for each language: every public name of its layer, with its signature and its sentences.

A page is a list of sections of groups of members (page.py). Each language has a module that reads its layer: Python by
`ast`, C# and JavaScript by their braces (braces.py), Lua by what tools/annotate knows of it. Sentences are the layer's
own; where it has none they are those of the function of include/feather.h that a member calls, in the language's words.
"""
