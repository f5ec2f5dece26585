// C. Schlick, "An inexpensive BRDF model for physically-based rendering", 1994; E[2.2-17]:
//
//     D = h² / (σh⁴ − h⁴/(2σ) + 1/(2σ))²
//
// Normalised, E[2.2-14], for every σ. The denominator as σh⁴ + (1 − h⁴)/(2σ), a sum of positive
// terms; at σ = 1/√2 it is 1/(2σ) and D = 2h².
Real schlick_slope(Angles angles, SchlickSlope m) {
    Real h = angles.n_dot_h;
    Real squared = h * h;
    Real below = m.roughness * (squared * squared) +
                 angles.n_h_versine * (Real(1) + h) * (Real(1) + squared) / (Real(2) * m.roughness);
    Real root = h / below;
    return root * root;
}
