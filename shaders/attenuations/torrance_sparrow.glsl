// K. E. Torrance and E. M. Sparrow, "Theory for off-specular reflection", 1967; E[2.2-18]:
//
//     G = min(1, 2hk/i, 2hj/i),   returned as G/k
//
// Its slope breaks where the terms meet, and it knows no roughness. At k = 0 G/k is 2h/i (0 for a
// light on the horizon too). Where L and V are opposite, H does not exist and G is 0.
Real torrance_sparrow_attenuation(Angles angles, Real roughness) {
    Real j = angles.n_dot_l;
    Real k = angles.n_dot_v;
    Real quotient = j < k ? j / k : Real(1);
    Real masked = Real(2) * angles.n_dot_h / angles.v_dot_h * quotient;
    Real open = min(Real(1) / k, masked);
    return angles.n_dot_h > Real(0) ? open : Real(0);
}
