// G. J. Ward, "Measuring and modeling anisotropic reflection", 1992, as an exponent of Phong's
// highlight by C. Schlick, 1994; E[2.2-32] in E[2.2-5]:
//
//     ρ = d C_D (N·L) + s C_S (N·H)^n,   n = ab / (a − am² + bm²),   m = H′·T
//
// The exponent is a along the tangent (m² = 1) and b across it. Its inverse, not the exponent itself, is
// interpolated between the two, so the highlight's contours are no ellipses: they are waisted.
Lobes ward_phong(Angles angles, Terms terms, WardPhong m) {
    Real a = m.shininess_u;
    Real b = m.shininess_v;
    Real exponent = a * (b / (a * angles.bitangent + b * angles.tangent));
    Real highlight =
        m.specularness * cosine_power(angles.n_dot_h, angles.n_h_versine, exponent);
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
