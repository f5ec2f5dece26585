// GLSL only: what the models use and GLSL lacks, or leaves as coarse as a driver likes. Set in place of
// the built-in functions by the macros at the end, so that shaders/models/* read alike in both languages.

// M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 1964, 7.1.26: the error function
// of x ≥ 0, to 2e-7.
Real erf(Real x) {
    Real t = Real(1) / (Real(1) + Real(0.3275911) * x);
    Real sum = t * (Real(0.254829592) +
                    t * (Real(-0.284496736) +
                         t * (Real(1.421413741) + t * (Real(-1.453152027) + t * Real(1.061405429)))));
    return Real(1) - sum * exp(-(x * x));
}

// ln(1 + x), x from −½ to 0, by ln m = 2 (s + s³/3 + …), s = (m − 1)/(m + 1): to 2e-7 of itself, which a
// driver's logarithm of 1 + x is not.
Real log1p(Real x) {
    Real s = x / (Real(2) + x);
    Real s2 = s * s;
    Real series = Real(1.0 / 7.0) + s2 * (Real(1.0 / 9.0) + s2 * (Real(1.0 / 11.0) + s2 * Real(1.0 / 13.0)));
    series = Real(1) + s2 * (Real(1.0 / 3.0) + s2 * (Real(0.2) + s2 * series));
    return Real(2) * s * series;
}

// S. L. Moshier, Cephes Mathematical Library, asinf.c: the arcsine of x from 0 to ½, to 3e-7 of itself.
Real arcsine_below_half(Real x) {
    Real z = x * x;
    Real series = ((Real(4.2163199048e-2) * z + Real(2.4181311049e-2)) * z + Real(4.5470025998e-2)) * z;
    return x + x * z * ((series + Real(7.4953002686e-2)) * z + Real(1.6666752422e-1));
}

// For x from 0 to 1, by the half angle above ½. A driver's own may be off by 1e-4, also next to x = 1,
// where the angle itself is small.
Real steady_asin(Real x) {
    bool low = x < Real(0.5);
    Real part = arcsine_below_half(low ? x : sqrt(Real(0.5) * (Real(1) - x)));
    return low ? part : Real(1.57079632679489661923) - Real(2) * part;
}

// xy + z rounded once: a driver may round the product too (llvmpipe does), and what the models use fma
// for, the error of a product, is 0 then.
Real fused(Real x, Real y, Real z) {
    return Real(double(x) * double(y) + double(z));
}

// As C++ has it for eight lanes, of which each chooses for itself.
Real select(bool which, Real yes, Real no) { return which ? yes : no; }
Vec3 select(bool which, Vec3 yes, Vec3 no) { return which ? yes : no; }

#define asin steady_asin
#define fma fused
