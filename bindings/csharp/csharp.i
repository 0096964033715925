// What feather.h's types become in C#: records are blittable structs, handles ulong, arrays pointers that the layer above pins.
