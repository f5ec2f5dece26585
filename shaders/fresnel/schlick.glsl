// C. Schlick, 1994; E[2.2-12], from the reflectance f at normal incidence:
//     F = f + (1 − f)(1 − u)⁵
// Affine in (1 − u)⁵, so that a renderer splits it into f and white.
Real schlick_rise(Real u) {
    Real away = Real(1) - u;
    Real squared = away * away;
    return squared * squared * away;
}
