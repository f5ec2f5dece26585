// J. H. Lambert, Photometria, 1760; the first term of E[2.2-5]:
//
//     ρ = d C_D (N·L)
//
// Reciprocal but for its N·L; its hemispherical reflectance is d C_D.
Lobes lambert(Angles angles, Terms terms, Lambert m) {
    Lobes lobes;
    lobes.diffuse = m.diffuseness * terms.diffuse;
    lobes.specular = Real(0);
    lobes.white = Real(0);
    lobes.fresnel = Real(0);
    lobes.cosine = Real(0);
    lobes.height = Real(-1);
    lobes.spread = Real(0);
    return lobes;
}
