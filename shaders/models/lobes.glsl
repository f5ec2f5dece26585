// What a model gets and gives: cosines in, weights out. Compiled as GLSL with `Real` = float, and
// as C++ in namespaces f32 and f64 (common/models). See shaders/README.md for the rules.

// The angles at one point for one light, mostly as cosines in [0, 1]; 0 where an angle is above 90°.
// Letters as in Fig. 2-1: N normal, L to the light, V to the viewer, H their bisector, R the mirror
// image of L, T the tangent.
struct Angles {
    Real n_dot_l;      // j
    Real n_dot_v;      // k
    Real n_dot_h;      // h
    Real v_dot_h;      // i, the same as L·H
    Real r_dot_v;      // l
    Real azimuth;      // C of E[2.2-29]: between L and V projected on the surface, -1 to 1
    Real tangent;      // m²: squared cosine between T and H projected on the surface; 1 at H = N
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
// They hold N·L where the model's equation does. Where the material has no Fresnel term F is C_S.
struct Lobes {
    Real diffuse;
    Real specular;
    Real white;
    Real fresnel;
    Real cosine;
};
