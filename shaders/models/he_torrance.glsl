// X. D. He, K. E. Torrance, F. X. Sillion and D. P. Greenberg, "A comprehensive physical model for light
// reflection", 1991, for light that is not polarised; a true BRDF times N·L and the solid angle ω of the light:
//
//     ρ = ω [d a (N·L)/π + s F(V·H) G S D/(π (N·V))]
//     G = (v²/v_z)² = 4 (V·H)²/(N·H)²,   v = (2π/λ)(L + V)
//     S = S(N·L) S(N·V), as in masking.glsl with slopes of √2 σ0/τ
//     D = π²τ²/(4λ²) Σ g^m e^(−g)/(m! m) exp(−v_xy²τ²/(4m)), m from 1,   g = σ² v_z²
//     σ² = σ0²/(1 + z²),   z exp(z²/2) = (K(N·L) + K(N·V))/(4 √(π/2)),   K(θ) = tan θ erfc(τ cot θ/(2σ0))
//
// σ0 is the roughness, τ the correlation length; σ is what of the roughness is seen, as valleys are hidden at
// grazing angles (their z0 is z σ0; z² = W(c²) for z exp(z²/2) = c). The model's G for unpolarised light has two
// more factors, the squared lengths of each direction's part along the other's s and p; either is 1 − (L·V)², by
// which the model divides. d a is the uniform diffuse part. The coherent one, F e^(−g) S within the mirrored light,
// is a mirror's: he_torrance_mirror.
//
// What depends on wavelength but F is D v_z^−2 (λ/2π)²… = Σ, which is left to ripples.glsl: the weights have
// (τ σ (V·H)²)² in front of it, so that nothing is divided by N·L + N·V, which vanishes at grazing.

// K of a cosine x, v = 1 − x.
Real he_torrance_slope(Real x, Real v, HeTorrance m) {
    Real sine = sqrt(v * (Real(1) + x));
    Real tangent = sine / max(x, Real(1e-12));  // at grazing all is hidden, but slowly: 1/(1 + ln) of it
    Real cotangent = x / max(sine, Real(1e-12));
    return tangent * (Real(1) - erf(min(Real(0.5) * m.correlation_length / m.rms_roughness * cotangent, Real(10))));
}

// σ², µm².
Real he_torrance_seen(Real slopes, HeTorrance m) {
    Real c = Real(0.19947114020071633897) * slopes;  // 1/(4 √(π/2))
    return m.rms_roughness * m.rms_roughness / (Real(1) + lambert_w(c * c));
}

Lobes he_torrance(Angles angles, Terms terms, HeTorrance m) {
    Real share = angles.solid_angle * Real(0.318309886183790671538);  // ω/π
    Real slopes = Real(1.41421356237309504880) * m.rms_roughness / m.correlation_length;
    Real seen = he_torrance_seen(he_torrance_slope(angles.n_dot_l, angles.n_l_versine, m) +
                                     he_torrance_slope(angles.n_dot_v, angles.n_v_versine, m),
                                 m);
    Real masking = angles.n_dot_l * smith_over_cosine(angles.n_dot_l, angles.n_l_versine, slopes) *
                   smith_over_cosine(angles.n_dot_v, angles.n_v_versine, slopes);
    Real i2 = angles.v_dot_h * angles.v_dot_h;
    Real along = angles.n_dot_l + angles.n_dot_v;
    Real across = i2 * angles.n_h_versine * (Real(1) + angles.n_dot_h);  // (v_xy/2)² at 2π/λ = 1
    Real length = m.correlation_length * i2;
    Lobes lobes;
    lobes.diffuse = m.diffuseness * share * terms.diffuse;
    lobes.specular = Real(0);
    lobes.white = Real(0);
    lobes.fresnel = m.specularness * share * masking * seen * (length * length);
    lobes.cosine = angles.v_dot_h;
    lobes.height = seen * (along * along);
    lobes.spread = m.correlation_length * m.correlation_length * across;
    return lobes;
}

// The coherent part at the cosine x, v = 1 − x: a mirror of F S exp(−(4πs/λ)²).
struct RoughMirror {
    Real masking;  // S
    Real depth;    // s = σ (N·V), µm
};
RoughMirror he_torrance_mirror(Real x, Real v, HeTorrance m) {
    Real one = x * smith_over_cosine(x, v, Real(1.41421356237309504880) * m.rms_roughness / m.correlation_length);
    RoughMirror mirror;
    mirror.masking = one * one;
    mirror.depth = x * sqrt(he_torrance_seen(Real(2) * he_torrance_slope(x, v, m), m));
    return mirror;
}
