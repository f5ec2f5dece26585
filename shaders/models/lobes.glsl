// What a model gets and gives: cosines in, weights out. Compiled as GLSL with `Real` = float, and
// as C++ in namespaces f32 and f64 (server/models/models.h). See shaders/README.md for the rules.

// The angles at one point for one light, as cosines in [0, 1]; 0 where the angle is above 90°.
struct Angles {
    Real n_dot_l;  // normal and direction to the light: j = N·L
    Real n_dot_h;  // normal and bisector of light and viewer: h = H·N
};

// The weights of one light's reflection: ρ(λ) = diffuse C_D(λ) + specular C_S(λ) + white.
// They hold N·L where the model's equation does.
struct Lobes {
    Real diffuse;
    Real specular;
    Real white;
};
