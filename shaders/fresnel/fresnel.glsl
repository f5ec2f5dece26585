// The Fresnel term F(u): how much of unpolarised light a smooth surface reflects at the cosine u,
// 0 to 1, of the angle of incidence. All tend to 1 at grazing incidence, u = 0.

// By Schlick's approximation (schlick.glsl), from the reflectance f at normal incidence; E[2.2-12].
Real schlick_fresnel(Real u, Real f) {
    return f + (Real(1) - f) * schlick_rise(u);
}

// The index of refraction behind the reflectance f < 1 at normal incidence, k = 0; E[2.2-11]:
//     n = (1 + √f)/(1 − √f) = (1 + √f)²/(1 − f)
Real index_from_reflectance(Real f) {
    Real root = Real(1) + sqrt(f);
    return root * root / (Real(1) - f);
}

// n² + u² − 1 for n below 1 is a difference near the critical angle, and F a root of it: it is summed
// with the rounding errors of both squares (exact products by fma).
Real squares_above_one(Real n, Real u) {
    Real n2 = n * n;
    Real u2 = u * u;
    Real errors = fma(n, n, -n2) + fma(u, u, -u2);
    return ((max(n2, u2) - Real(1)) + min(n2, u2)) + errors;
}

// Exact for a dielectric of index n; E[2.2-9]:
//     F = ½ (a−u)²/(a+u)² ((u(a+u)−1)²/(u(a−u)+1)² + 1),   a = √(n² + u² − 1)
// Below the critical angle's cosine, where a is imaginary, all is reflected. With a − u =
// (n² − 1)/(a + u) and u(a+u) − 1 = ua − (1−u²) nothing cancels but what vanishes. At n = 1 it is 0,
// at grazing incidence too: (a + u)² is at least |n² − 1|, so its bound acts at n = 1 alone.
Real dielectric_fresnel(Real u, Real n) {
    Real t = squares_above_one(n, u);
    Real a = sqrt(max(t, Real(0)));
    Real sum = a + u;
    Real across = (n - Real(1)) * (n + Real(1)) / max(sum * sum, Real(1e-30));
    Real sine2 = (Real(1) - u) * (Real(1) + u);
    Real along = (u * a - sine2) / (u * a + sine2);
    Real part = Real(0.5) * across * across * (Real(1) + along * along);
    return t < Real(0) ? Real(1) : part;
}

// Exact for a conductor of index n and extinction coefficient k; E[2.2-8]:
//     F = ½ ((a−u)²+b²)/((a+u)²+b²) (((a+u−1/u)²+b²)/((a−u+1/u)²+b²) + 1)
//     a² = ½(√(t² + 4n²k²) + t),  b² = ½(√(t² + 4n²k²) − t),  t = n² − k² + u² − 1
// The source prints −1 in place of +1 in b². Both fractions of the second factor are multiplied by
// u², so u = 0 is no exception. b = nk/a or a = nk/b, whichever does not cancel, and
// a² − u² = 2 (u²(n²−1) + k²(n²−u²))/(s + u² − q) where that is the sum of like signs, q = n²−1−k².
Real conductor_fresnel(Real u, Real n, Real k) {
    Real t = squares_above_one(n, u) - k * k;
    Real nk = n * k;
    Real s = sqrt(t * t + Real(4) * nk * nk);
    Real larger = sqrt(Real(0.5) * (s + abs(t)));
    Real smaller = nk / max(larger, Real(1e-30));
    Real a = t < Real(0) ? smaller : larger;
    Real b = t < Real(0) ? larger : smaller;
    Real q = (n - Real(1)) * (n + Real(1)) - k * k;
    Real away = u * u - q;
    Real product = u * u * ((n - Real(1)) * (n + Real(1))) + k * k * ((n - u) * (n + u));
    Real difference = away > Real(0) ? Real(2) * product / (s + away) : Real(0.5) * (s - away);
    Real sum = a + u;
    Real apart = sum > Real(0) ? difference / sum : Real(0);
    Real below = sum * sum + b * b;
    Real across = (apart * apart + b * b) / below;
    Real sine2 = (Real(1) - u) * (Real(1) + u);
    Real less = u * a - sine2;
    Real more = u * a + sine2;
    Real bu = b * u;
    Real along = (less * less + bu * bu) / (more * more + bu * bu);
    return below > Real(0) ? Real(0.5) * across * (Real(1) + along) : Real(0);
}
