// B. G. Smith, "Geometrical shadowing of a random rough surface", 1967, in the form of X. D. He et al., 1991;
// E[2.2-19] (attenuations/smith.glsl): how much of a surface of slopes σ is seen at the cosine x. Evaluated
// as g′/(g′ + e^−q), g′ = g e^−q, and divided by x: no overflow as x → 1, no 0/0 as x → 0.

// G(x)/x, v = 1 − x; at x = 0 it is √(π/2)/σ.
Real smith_over_cosine(Real x, Real v, Real roughness) {
    Real sine = sqrt(v * (Real(1) + x));
    Real inverse = roughness * Real(1.41421356237309504880) * sine;  // √2 σ sin θ = x/√q
    Real root = x / max(inverse, Real(1e-30));
    Real rising = Real(1.77245385090551602730) * (Real(1) + erf(root));
    return rising / (rising * x + inverse * exp(-(root * root)));
}
