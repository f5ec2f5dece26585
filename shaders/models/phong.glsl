// B. T. Phong, "Illumination for computer generated pictures", 1975; E[2.2-4]:
//
//     ρ = d C_D ((1 − a)(N·L) + a) + s W(N·L) (R·V)^n
//
// a is the environmental coefficient (the source's d): light from all around, also in the shade.
// W, "the ratio of the specular reflected light and the incident light as a function of the incident
// angle", is the material's Fresnel term at N·L; without one it is C_S, 1 when left out.
// Not reciprocal: W sees the light's angle alone. The highlight ends at the terminator.
Lobes phong(Angles angles, Terms terms, Phong m) {
    Real highlight =
        m.specularness * cosine_power(angles.r_dot_v, angles.r_v_versine, m.shininess);
    Lobes lobes;
    lobes.diffuse = m.diffuseness * ((Real(1) - m.ambient) * terms.diffuse + m.ambient);
    lobes.specular = Real(0);
    lobes.white = Real(0);
    lobes.fresnel = angles.n_dot_l > Real(0) ? highlight : Real(0);
    lobes.cosine = angles.n_dot_l;
    lobes.height = Real(-1);
    lobes.spread = Real(0);
    return lobes;
}
