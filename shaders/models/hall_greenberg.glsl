// R. A. Hall and D. P. Greenberg, "A testbed for realistic image synthesis", 1983; E[2.2-7]:
//
//     ρ = d C_D (N·L) + s F(V·H) (N·H)^n
//
// Blinn–Phong whose highlight takes its colour from the Fresnel term.
Lobes hall_greenberg(Angles angles, Terms terms, HallGreenberg m) {
    Real highlight =
        m.specularness * cosine_power(angles.n_dot_h, angles.n_h_versine, m.shininess);
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
