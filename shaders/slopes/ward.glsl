// G. J. Ward, "Measuring and modeling anisotropic reflection", 1992, E[2.2-30], with the h⁴ by which
// C. Schlick, 1994, normalised it; E[2.2-31]:
//
//     D = exp((h² − 1)/h² (m²/a² + (1 − m²)/b²)) / (ab h⁴),   m = H′·T
//
// With a = b it is Beckmann's. 1/h² is bounded as there.
Real ward_slope(Angles angles, WardSlope m) {
    Real h = angles.n_dot_h;
    Real steep = min(Real(1) / (h * h), Real(1e10));
    Real along = angles.tangent / (m.roughness_u * m.roughness_u);
    Real across = angles.bitangent / (m.roughness_v * m.roughness_v);
    Real exponent = -(angles.n_h_versine * (Real(1) + h)) * steep * (along + across);
    return (steep * steep) * exp(exponent) / (m.roughness_u * m.roughness_v);
}
