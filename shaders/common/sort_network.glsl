// SPDX-License-Identifier: MIT
// Sorting in registers: Batcher's odd-even merge networks (1968), written out by macros because a loop that a compiler
// does not unroll would put the arrays into memory.  Fragments are sorted nearest first; equal depth: later drawn first.
#ifndef PELLUCID_SORT_NETWORK_GLSL
#define PELLUCID_SORT_NETWORK_GLSL

struct Key {
    float depth;  // reversed: greater is nearer; -1 is behind every fragment
    int order;    // draw order
    uint place;   // what is sorted
};

bool in_front(Key a, Key b) { return a.depth > b.depth || (a.depth == b.depth && a.order > b.order); }

// Puts the nearer of the two into `a`.
void compare_swap(inout Key a, inout Key b) {
    bool swap = in_front(b, a);
    Key nearer = Key(swap ? b.depth : a.depth, swap ? b.order : a.order, swap ? b.place : a.place);
    b = Key(swap ? a.depth : b.depth, swap ? a.order : b.order, swap ? a.place : b.place);
    a = nearer;
}

// Merges the two sorted halves of k[a], k[a + r], k[a + 2r], …
#define CAS(k, i, j) compare_swap(k[i], k[j]);
#define MERGE2(k, a, r) CAS(k, (a), (a) + (r))
#define MERGE4(k, a, r) MERGE2(k, a, 2 * (r)) MERGE2(k, (a) + (r), 2 * (r)) CAS(k, (a) + (r), (a) + 2 * (r))
#define MERGE8(k, a, r) MERGE4(k, a, 2 * (r)) MERGE4(k, (a) + (r), 2 * (r)) CAS(k, (a) + (r), (a) + 2 * (r)) \
    CAS(k, (a) + 3 * (r), (a) + 4 * (r)) CAS(k, (a) + 5 * (r), (a) + 6 * (r))
#define MERGE16(k, a, r) MERGE8(k, a, 2 * (r)) MERGE8(k, (a) + (r), 2 * (r)) CAS(k, (a) + (r), (a) + 2 * (r)) \
    CAS(k, (a) + 3 * (r), (a) + 4 * (r)) CAS(k, (a) + 5 * (r), (a) + 6 * (r)) \
    CAS(k, (a) + 7 * (r), (a) + 8 * (r)) CAS(k, (a) + 9 * (r), (a) + 10 * (r)) \
    CAS(k, (a) + 11 * (r), (a) + 12 * (r)) CAS(k, (a) + 13 * (r), (a) + 14 * (r))
#define MERGE32(k, a, r) MERGE16(k, a, 2 * (r)) MERGE16(k, (a) + (r), 2 * (r)) CAS(k, (a) + (r), (a) + 2 * (r)) \
    CAS(k, (a) + 3 * (r), (a) + 4 * (r)) CAS(k, (a) + 5 * (r), (a) + 6 * (r)) \
    CAS(k, (a) + 7 * (r), (a) + 8 * (r)) CAS(k, (a) + 9 * (r), (a) + 10 * (r)) \
    CAS(k, (a) + 11 * (r), (a) + 12 * (r)) CAS(k, (a) + 13 * (r), (a) + 14 * (r)) \
    CAS(k, (a) + 15 * (r), (a) + 16 * (r)) CAS(k, (a) + 17 * (r), (a) + 18 * (r)) \
    CAS(k, (a) + 19 * (r), (a) + 20 * (r)) CAS(k, (a) + 21 * (r), (a) + 22 * (r)) \
    CAS(k, (a) + 23 * (r), (a) + 24 * (r)) CAS(k, (a) + 25 * (r), (a) + 26 * (r)) \
    CAS(k, (a) + 27 * (r), (a) + 28 * (r)) CAS(k, (a) + 29 * (r), (a) + 30 * (r))

#define SORT2(k, a) MERGE2(k, a, 1)
#define SORT4(k, a) SORT2(k, a) SORT2(k, (a) + 2) MERGE4(k, a, 1)
#define SORT8(k, a) SORT4(k, a) SORT4(k, (a) + 4) MERGE8(k, a, 1)
#define SORT16(k, a) SORT8(k, a) SORT8(k, (a) + 8) MERGE16(k, a, 1)
#define SORT32(k, a) SORT16(k, a) SORT16(k, (a) + 16) MERGE32(k, a, 1)
#endif
