// K. E. Torrance and E. M. Sparrow, "Theory for off-specular reflection", 1967; E[2.2-15]:
//
//     D = c exp(−(α/σ)²),   α = acos h = 2 asin √((1 − h)/2)
//
// The source prints h in place of α, which would put the peak off the mirror direction. Proportional:
// D = c there.
Real gaussian_slope(Angles angles, GaussianSlope m) {
    Real x = Real(2) * asin(sqrt(Real(0.5) * angles.n_h_versine)) / m.roughness;
    return m.scale * exp(-(x * x));
}
