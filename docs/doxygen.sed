# What Doxygen 1.9.4 cannot read of our files, put in its own words (docs/Doxyfile).
# It takes `namespace a::inline b` for a namespace called b.
s/namespace pellucid::inline v[0-9_]+/namespace pellucid/
# Pages: blocks of code stay as they are; markers go; formulae are between \f[ and \f$; it has no anchors of headings;
# pictures are found by their names (IMAGE_PATH); files that have no page are named and not linked.
/^ *```/,/^ *```$/b
s/^<!-- (snippet|from): .* -->$//
s/!\[([^]]*)\]\(([^)]*\/)?([^)\/]+\.(png|svg))\)/![\1](\3)/g
s/(^|[^!])\[([^]]*)\]\([^)]*(\.glsl|\.frag|\.vert|\.comp|\.svg|\.txt|\.json|samples\/custom_pass|include\/pellucid\/reference|results|tests\/(passes|hard_cases|renderer)|benchmarks\/[a-z_]*\.cpp)\)/\1\2/g
s/\[`?([^]`]*)`?\]\([^)]*include\/(pellucid\/[^)]*\.(hpp|h))\)/\\ref \2 "\1"/g
s/\]\(([^)]*\.md)#[^)]*\)/](\1)/g
s/^\$\$ /\\f[ /
s/ \$\$$/ \\f]/
/^\|/!s/\$([^$`]+)\$/\\f$\1\\f$/g
/^\|/s/\$([^$`|]+)\$/\\f$\1\\f$/g
