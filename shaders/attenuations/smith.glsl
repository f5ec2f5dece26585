// B. G. Smith, "Geometrical shadowing of a random rough surface", 1967, in the form of X. D. He et al.,
// 1991; E[2.2-19]:
//
//     G = G(j) G(k), returned as G/k;   G(x) = g/(g + 1),
//     g = √(πq) e^q (2 − erfc √q),   q = x²/(2σ²(1 − x²))
//
// The source prints g − 1, no e^q and 4σ²: as printed G is negative or above 1. With 2σ² its slope at
// the horizon is that of its own approximation E[2.2-20]. G(x)/x: models/masking.glsl.
Real smith_attenuation(Angles angles, Real roughness) {
    return angles.n_dot_l * smith_over_cosine(angles.n_dot_l, angles.n_l_versine, roughness) *
           smith_over_cosine(angles.n_dot_v, angles.n_v_versine, roughness);
}
