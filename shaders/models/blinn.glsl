// J. F. Blinn, "Models of light reflection for computer synthesized pictures", 1977; E[2.2-21]:
//
//     ρ = d C_D (N·L) + s F(V·H) D G / (N·V)
//
// Meant for distributions with D = 1 in the mirror direction (trowbridge_reitz, gaussian).
Lobes blinn(Angles angles, Terms terms, Blinn m) {
    Real highlight = m.specularness * terms.slope * terms.attenuation;
    Lobes lobes;
    lobes.diffuse = m.diffuseness * terms.diffuse;
    lobes.specular = Real(0);
    lobes.white = Real(0);
    lobes.fresnel = angles.n_dot_l > Real(0) ? highlight : Real(0);
    lobes.cosine = angles.v_dot_h;
    lobes.height = Real(-1);
    lobes.spread = Real(0);
    return lobes;
}
