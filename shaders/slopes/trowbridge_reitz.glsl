// T. S. Trowbridge and K. P. Reitz, "Average irregularity representation of a rough surface for ray
// reflection", 1975; E[2.2-22]:
//
//     D = (σ² / (h²(σ² − 1) + 1))²
//
// Proportional: D = 1 in the mirror direction. The denominator as σ²h² + (1 − h²).
Real trowbridge_reitz_slope(Angles angles, TrowbridgeReitzSlope m) {
    Real h = angles.n_dot_h;
    Real variance = m.roughness * m.roughness;
    Real root = variance / (variance * (h * h) + angles.n_h_versine * (Real(1) + h));
    return root * root;
}
