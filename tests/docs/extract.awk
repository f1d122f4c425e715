# Finds the blocks of a page that are compiled or configured, and writes each to a file of its own.
#   awk -v out=FOLDER -v page=docs/x.md -v id=docs_x -f extract.awk docs/x.md
# A block is marked by an HTML comment in the line before it:
#   <!-- snippet: body, setup=renderer -->   the body of a function, with what tests/docs/setups/renderer.hpp has in scope
#   <!-- snippet: file -->                   a translation unit
#   <!-- snippet: program -->                one that is linked, too
#   <!-- snippet: configure -->              lines of a CMakeLists.txt
# Prints "kind setup file" for each; setup is - where there is none.
/^<!-- snippet: .* -->$/ { marker = $0; next }
/^```(cpp|cmake)$/ && marker != "" {
    kind = marker; sub(/^<!-- snippet: /, "", kind); sub(/[, ].*$/, "", kind)
    setup = "-"
    if (match(marker, /setup=[a-z_]+/)) setup = substr(marker, RSTART + 6, RLENGTH - 6)
    file = out "/" id "_" NR (kind == "configure" ? ".cmake" : kind == "body" ? ".inc" : ".cpp")
    if (kind != "configure") printf "#line %d \"%s\"\n", NR + 1, page > file
    else printf "" > file
    print kind, setup, file
    inside = 1; marker = ""; next
}
/^```/ { if (inside) close(file); inside = 0 }
inside { print > file }
$0 !~ /^<!-- snippet/ { marker = "" }
