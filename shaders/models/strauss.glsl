// P. S. Strauss, "A realistic lighting model for computer animators", 1990; E[2.2-23] to E[2.2-28]:
//
//     ρ = d C_D (N·L) + s C_S (R·V)^n,     d = (1 − o³)(1 − po),   n = 3/(1 − o)
//     s = min(1, o³ + (o³ + k_s) F(x) G(x) G(x′)),   C_S = 1 + p (1 − F(x))(C_D − 1)
//     F(x) = [1/(x−k_f)² − 1/k_f²] / [1/(1−k_f)² − 1/k_f²]
//     G(x) = [1/(1−k_g)² − 1/(x−k_g)²] / [1/(1−k_g)² − 1/k_g²],   x = θ/(π/2), of L; x′ of V
//
// E[2.2-27] and E[2.2-28] are garbled in the source; these follow its errata. As written F and G
// cancel; with y = 1 − x they factor into
//     rise(x) = x (2k − x)(1−k)² / ((2k − 1)(y + k−1)²),
//     fall(y) = y (y + 2(k−1)) k² / ((2k − 1)(y + k−1)²),
// and F = rise, 1 − F = fall with k_f, G = fall with k_g. The exponent has no finite value at o = 1.
// Not reciprocal: F sees the light's angle alone.
Real strauss_rise(Real x, Real y, Real k) {
    Real away = y + (k - Real(1));
    return x * (Real(2) * k - x) * ((k - Real(1)) / away) * ((k - Real(1)) / away) /
           (Real(2) * k - Real(1));
}

Real strauss_fall(Real y, Real k) {
    Real away = y + (k - Real(1));
    return (y / away) * ((y + Real(2) * (k - Real(1))) / away) * (k * k / (Real(2) * k - Real(1)));
}

// The angle above the horizon whose sine is `sine`, in right angles; v = 1 − sine.
Real strauss_height(Real sine, Real v) {
    Real quarters = Real(0.636619772367581343076);  // per radian: 2/π
    Real above = quarters * asin(sine);
    Real below = Real(1) - Real(2) * quarters * asin(sqrt(Real(0.5) * v));
    return v < Real(0.3) ? below : above;
}

Lobes strauss(Angles angles, Terms terms, Strauss m) {
    Real x = Real(2) * Real(0.636619772367581343076) * asin(sqrt(Real(0.5) * angles.n_l_versine));
    Real y = strauss_height(angles.n_dot_l, angles.n_l_versine);
    Real y_v = strauss_height(angles.n_dot_v, angles.n_v_versine);
    Real fresnel = strauss_rise(x, y, m.k_f);
    Real shown = strauss_fall(y, m.k_g) * strauss_fall(y_v, m.k_g);
    Real o = m.smoothness;
    Real cube = o * o * o;
    Real s = min(Real(1), cube + (cube + m.k_s) * (fresnel * shown));
    Real highlight =
        s * cosine_power(angles.r_dot_v, angles.r_v_versine, Real(3) / (Real(1) - o));
    highlight = angles.n_dot_l > Real(0) ? highlight : Real(0);
    Real rough = (Real(1) - o) * (Real(1) + o + o * o);                       // 1 − o³
    Real paint = (Real(1) - o) + o * (Real(1) - m.metalness);                // 1 − po
    Lobes lobes;
    lobes.diffuse = rough * paint * terms.diffuse +
                    highlight * (m.metalness * strauss_fall(y, m.k_f));
    lobes.specular = Real(0);
    lobes.white = highlight * ((Real(1) - m.metalness) + m.metalness * fresnel);
    lobes.fresnel = Real(0);
    lobes.cosine = Real(0);
    lobes.height = Real(-1);
    lobes.spread = Real(0);
    return lobes;
}
