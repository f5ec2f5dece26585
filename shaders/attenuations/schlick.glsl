// C. Schlick, "An inexpensive BRDF model for physically-based rendering", 1994; E[2.2-20]:
//
//     G = G(j) G(k), returned as G/k;   G(x) = x / (x − cx + c),   c = √(2σ²/π)
//
// c is below 1 for every σ up to 1, so x (1 − c) + c does not cancel. (Appendix D-4 has y − ty + y.)
Real schlick_attenuation(Angles angles, Real roughness) {
    Real c = roughness * Real(0.797884560802865355880);  // √(2/π)
    Real j = angles.n_dot_l;
    return j / (j * (Real(1) - c) + c) / (angles.n_dot_v * (Real(1) - c) + c);
}
