# What Doxygen 1.9.4 cannot read of our files, put in its own words (docs/Doxyfile).
# It takes `namespace a::inline b` for a namespace called b.
s/namespace pellucid::inline v[0-9_]+/namespace pellucid/
# Pages: blocks of code stay as they are; markers go; formulae are between \f[ and \f$; it has no anchors of headings.
/^ *```/,/^ *```$/b
s/^<!-- (snippet|from): .* -->$//
s/\]\(([^)]*\.md)#[^)]*\)/](\1)/g
s/^\$\$ /\\f[ /
s/ \$\$$/ \\f]/
/^\|/!s/\$([^$`]+)\$/\\f$\1\\f$/g
/^\|/s/\$([^$`|]+)\$/\\f$\1\\f$/g
