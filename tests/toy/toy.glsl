// No paper: a highlight that is a step,
//
//     ρ = d C_D (N·L) + s [N·H > edge]
Lobes toy(Angles angles, Terms terms, Toy m) {
    Lobes lobes;
    lobes.diffuse = m.diffuseness * terms.diffuse;
    lobes.specular = Real(0);
    lobes.white = angles.n_dot_h > m.edge ? m.specularness : Real(0);
    lobes.fresnel = Real(0);
    lobes.cosine = Real(0);
    lobes.height = Real(-1);
    lobes.spread = Real(0);
    return lobes;
}
