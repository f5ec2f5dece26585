// J. F. Blinn, "Models of light reflection for computer synthesized pictures", 1977; E[2.2-5]:
//
//     ρ = d C_D (N·L) + s C_S (N·H)^n
//
// The highlight has no factor N·L, so it does not fade towards the terminator: it ends there.
Lobes blinn_phong(Angles angles, Terms terms, BlinnPhong m) {
    Real highlight =
        m.specularness * cosine_power(angles.n_dot_h, angles.n_h_versine, m.shininess);
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
