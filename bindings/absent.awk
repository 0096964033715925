# Weak definitions of all functions of feather.h, linked behind the library: a module loads also while the library lacks
# some of them.
BEGIN { print "#include \"feather.h\"" }
/^FE_API/ { text = ""; on = 1 }
on { text = text " " $0 }
on && /;/ {
    on = 0
    sub(/FE_API/, "__attribute__((weak))", text)
    match(text, /weak\)\) .*fe_[a-z0-9_]+\(/)
    kind = text ~ /weak\)\) void / ? "" : text ~ /const char \*fe_/ ? "return \"\";" : "return -7;"
    sub(/;.*/, "", text)
    print text " { " kind " }"
}
