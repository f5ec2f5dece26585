// C. Schlick, "A fast alternative to Phong's specular model", Graphics Gems IV, 1994; E[2.2-6]:
//
//     ρ = d C_D (N·L) + s C_S h / (h − hp + p),   h = N·H
//
// The denominator as h + p (1 − h), which does not cancel. At p = 1 the highlight is h itself.
Lobes schlick(Angles angles, Terms terms, Schlick m) {
    Real h = angles.n_dot_h;
    Real highlight = m.specularness * (h / (h + m.falloff * angles.n_h_versine));
    Lobes lobes;
    lobes.diffuse = m.diffuseness * terms.diffuse;
    lobes.specular = angles.n_dot_l > Real(0) ? highlight : Real(0);
    lobes.white = Real(0);
    lobes.fresnel = Real(0);
    lobes.cosine = Real(0);
    lobes.height = Real(-1);
    lobes.spread = Real(0);
    return lobes;
}
