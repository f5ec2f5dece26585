// R. L. Cook and K. E. Torrance, "A reflectance model for computer graphics", 1981; E[2.2-13] times
// N·L and the solid angle ω of the light, which make radiance of this true BRDF:
//
//     ρ = ω [d C_D (N·L) / π + s F(V·H) D G / (4π (N·V))]
//
// With ω = π a diffuse white reflects as in the other models. At the horizon, where N·V vanishes, D G
// / (N·V) has a limit (attenuations/*.glsl); the highlight ends at the terminator.
Lobes cook_torrance(Angles angles, Terms terms, CookTorrance m) {
    Real share = angles.solid_angle * Real(0.318309886183790671538);  // ω/π
    Real highlight = m.specularness * (Real(0.25) * share) * terms.slope * terms.attenuation;
    Lobes lobes;
    lobes.diffuse = m.diffuseness * share * terms.diffuse;
    lobes.specular = Real(0);
    lobes.white = Real(0);
    lobes.fresnel = angles.n_dot_l > Real(0) ? highlight : Real(0);
    lobes.cosine = angles.v_dot_h;
    lobes.height = Real(-1);
    lobes.spread = Real(0);
    return lobes;
}
