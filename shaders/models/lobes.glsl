// What a model gets and gives: angles in, weights out. Compiled as GLSL with `Real` = float, and
// as C++ in namespaces f32 and f64 (common/models). See shaders/README.md for the rules.

// The angles at one point for one light, mostly as cosines in [0, 1]; 0 where an angle is above 90°.
// Letters as in Fig. 2-1: N normal, L to the light, V to the viewer, H their bisector, R the mirror
// image of L, T the tangent.
//
// A cosine next to 1 has lost the digits of a small angle: in f32 all angles below 2e-4 have the cosine
// 1. So each comes with its versine, 1 − cosine, which has them: what is sharp takes 1 − h and 1 − h² =
// (1 − h)(1 + h) from there, and never from the cosine.
struct Angles {
    Real n_dot_l;      // j
    Real n_dot_v;      // k
    Real n_dot_h;      // h
    Real v_dot_h;      // i, the same as L·H
    Real r_dot_v;      // l
    Real n_l_versine;  // 1 − j
    Real n_v_versine;  // 1 − k
    Real n_h_versine;  // 1 − h
    Real r_v_versine;  // 1 − l
    Real azimuth;      // C of E[2.2-29]: between L and V projected on the surface, -1 to 1
    Real tangent;      // m²: squared cosine between T and H projected on the surface; 1 at H = N
    Real bitangent;    // 1 − m²
    Real solid_angle;  // ω of the light, sr
};

// The parts that a model leaves open, evaluated at the same angles.
struct Terms {
    Real diffuse;      // N·L, or what a diffuse term makes of it
    Real slope;        // D: sum of the material's weighted slope distributions
    Real attenuation;  // G/(N·V): the geometric attenuation with the N·V that it cancels
};

// The weights of one light's reflection:
//     ρ(λ) = diffuse C_D(λ) + specular C_S(λ) + white + fresnel F(cosine; λ)
// They hold N·L where the model's equation does. Where the material has no Fresnel term F is C_S. Where `height`
// is not negative the last one depends on wavelength for its geometry, too: it is to be multiplied by ripples
// (ripples.glsl) of them.
struct Lobes {
    Real diffuse;
    Real specular;
    Real white;
    Real fresnel;
    Real cosine;
    Real height;  // g = (σ v_z)² at a wave number of 1/µm, µm²
    Real spread;  // (τ v_xy)²/4 there, µm²
};

// xⁿ of a cosine x, v = 1 − x; n > 0. Next to 1 by ln(1 − v), as n may be large: a rounding of x would
// count n times.
Real cosine_power(Real x, Real v, Real n) {
    Real near = log1p(-min(v, Real(0.5)));
    Real far = log(x);
    Real power = exp(n * (v < Real(0.5) ? near : far));
    return x > Real(0) ? power : Real(0);
}
