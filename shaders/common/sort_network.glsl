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
#define SORT2(k, a) MERGE2(k, a, 1)
#define SORT4(k, a) SORT2(k, a) SORT2(k, (a) + 2) MERGE4(k, a, 1)
#define SORT8(k, a) SORT4(k, a) SORT4(k, (a) + 4) MERGE8(k, a, 1)
#define SORT16(k, a) SORT8(k, a) SORT8(k, (a) + 8) MERGE16(k, a, 1)

// Sorts a bitonic sequence: one that rises and then falls, or the other way round (Batcher 1968).
#define BITONIC2(k, a) CAS(k, (a), (a) + 1)
#define BITONIC4(k, a) CAS(k, (a), (a) + 2) CAS(k, (a) + 1, (a) + 3) BITONIC2(k, a) BITONIC2(k, (a) + 2)
#define BITONIC8(k, a) CAS(k, (a), (a) + 4) CAS(k, (a) + 1, (a) + 5) CAS(k, (a) + 2, (a) + 6) \
    CAS(k, (a) + 3, (a) + 7) BITONIC4(k, a) BITONIC4(k, (a) + 4)
#define BITONIC16(k, a) CAS(k, (a), (a) + 8) CAS(k, (a) + 1, (a) + 9) CAS(k, (a) + 2, (a) + 10) \
    CAS(k, (a) + 3, (a) + 11) CAS(k, (a) + 4, (a) + 12) CAS(k, (a) + 5, (a) + 13) CAS(k, (a) + 6, (a) + 14) \
    CAS(k, (a) + 7, (a) + 15) BITONIC8(k, a) BITONIC8(k, (a) + 8)
#endif
