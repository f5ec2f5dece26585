// M. Oren and S. K. Nayar, "Generalization of Lambert's reflectance model", 1994; E[2.2-29]:
//
//     (A + B max(0, C) sin α tan β)(N·L),   α the larger and β the smaller angle of L and V with N,
//     A = 1 − 0.5 σ²/(σ² + 0.33),   B = 0.45 σ²/(σ² + 0.09)
//
// sin α tan β = sin θ sin θ′ / max(j, k); of that, N·L = j takes the quotient j / max(j, k), which is
// at most 1, so the term stays finite down to the horizon. It is 0 where the light is there. Not
// conserving: towards grazing light it reflects up to A + B/2, 1.015 at σ = 0.2.
Real oren_nayar_diffuse(Angles angles, OrenNayarDiffuse m) {
    Real j = angles.n_dot_l;
    Real k = angles.n_dot_v;
    Real variance = m.roughness * m.roughness;
    Real a = Real(1) - Real(0.5) * variance / (variance + Real(0.33));
    Real b = Real(0.45) * variance / (variance + Real(0.09));
    Real sine_l = sqrt(angles.n_l_versine * (Real(1) + j));
    Real sine_v = sqrt(angles.n_v_versine * (Real(1) + k));
    Real quotient = j < k ? j / k : Real(1);
    Real rough = b * max(Real(0), angles.azimuth) * sine_l * sine_v * quotient;
    return j > Real(0) ? a * j + rough : Real(0);
}
