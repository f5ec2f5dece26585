// A unit vector; a vector of length 0 stays 0.
Vec3 unit(Vec3 v) {
    Real squared = dot(v, v);
    return v * select(squared > Real(0), Real(1) / sqrt(squared), squared);
}
