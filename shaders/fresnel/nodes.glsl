// Where a cosine u in 0..1 lies in the table of an exact Fresnel term, whose nodes are at (i / last)²
// (common/scene/fresnel_table.h): between a node and the next,
Real node_below(Real u, Real last) {
    return min(floor(sqrt(u) * last), last - Real(1));
}

// and which share of the way from it.
Real node_share(Real u, Real below, Real last) {
    return (u * (last * last) - below * below) / (Real(2) * below + Real(1));
}
