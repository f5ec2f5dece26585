// P. Beckmann and A. Spizzichino, "The scattering of electromagnetic waves from rough surfaces",
// 1963; E[2.2-16]:
//
//     D = exp((h² − 1)/(σ²h²)) / (σ²h⁴)
//
// Normalised, E[2.2-14]. Where 1/h² passes 1e10 the exponential is 0 for every σ up to 1, and so is
// D; the bound keeps 1/h⁴ from infinity there.
Real beckmann_slope(Angles angles, BeckmannSlope m) {
    Real h = angles.n_dot_h;
    Real steep = min(Real(1) / (h * h), Real(1e10));
    Real peak = Real(1) / (m.roughness * m.roughness);
    return peak * (steep * steep) * exp(-(angles.n_h_versine * (Real(1) + h)) * steep * peak);
}
