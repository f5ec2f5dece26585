// FresnelKind of server/scene/render_scene.h.
const int fresnel_none = 0;
const int fresnel_schlick = 1;
const int fresnel_exact = 2;

// Lobes with the material's colour in the place of their Fresnel term where it is one: C_S, or C_S and
// white by Schlick's approximation. An exact one stays, and one of a lobe that depends on wavelength for its geometry,
// too.
Lobes fold_fresnel(Lobes lobes, int kind) {
    if (kind == fresnel_exact) return lobes;
    Real rise = kind == fresnel_schlick ? schlick_rise(lobes.cosine) : Real(0);
    Real folded = select(lobes.height < Real(0), lobes.fresnel, Real(0));
    lobes.specular = lobes.specular + folded * (Real(1) - rise);
    lobes.white = lobes.white + folded * rise;
    lobes.fresnel = lobes.fresnel - folded;
    return lobes;
}
