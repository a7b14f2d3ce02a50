#include "common/exact/zener_bar.hpp"

#include "common/exact/laplace_inversion.hpp"

#include <cmath>
#include <utility>

namespace diptych::exact {

namespace {

/// Transforms of u, v, strain, stress at once.
template <class Real>
struct Four {
  std::complex<Real> u{}, v{}, strain{}, stress{};

  Four& operator+=(const Four& o) {
    u += o.u;
    v += o.v;
    strain += o.strain;
    stress += o.stress;
    return *this;
  }
  Four operator*(std::complex<Real> c) const { return {u * c, v * c, strain * c, stress * c}; }
  Four operator-(const Four& o) const {
    return {u - o.u, v - o.v, strain - o.strain, stress - o.stress};
  }
};

/// The bar's material in the transformed domain.
template <class Real>
struct Medium {
  const ZenerBarParameters& p;
  Real front_speed;

  /// k - s/c without the cancellation of its two parts: s/c (M_glassy - M(s))/M(s) / (1 + ratio),
  /// where the difference of the moduli is sum M_a/(1 + s tau_a).
  std::complex<Real> lag(std::complex<Real> s, std::complex<Real> M) const {
    std::complex<Real> missing = 0;
    for (size_t a = 0; a < p.branch_moduli.size(); ++a)
      missing += Real(p.branch_moduli[a]) / (Real(1) + s * Real(p.branch_times[a]));
    const std::complex<Real> ratio = std::sqrt((M + missing) / M);
    return s / front_speed * (missing / M) / (Real(1) + ratio);
  }
  std::complex<Real> modulus(std::complex<Real> s) const {
    std::complex<Real> M = Real(p.modulus);
    for (size_t a = 0; a < p.branch_moduli.size(); ++a) {
      const std::complex<Real> z = s * Real(p.branch_times[a]);
      M += Real(p.branch_moduli[a]) * z / (Real(1) + z);
    }
    return M;
  }
  /// Answer along one path of length d to a load with the transform 1, front taken out. `sign` is
  /// that of the stress where the displacement counts +1.
  Four<Real> path(std::complex<Real> s, Real d, Real sign) const {
    const std::complex<Real> M = modulus(s), slowness = std::sqrt(Real(p.density) / M);
    const std::complex<Real> k = s * slowness;
    const std::complex<Real> decay = std::exp(-lag(s, M) * d);
    Four<Real> f;
    if (p.is_slab) {  // sigma = +-decay, u = decay / (M k)
      f.u = decay / (M * k);
      f.v = s * f.u;
      f.stress = sign * decay;
      f.strain = f.stress / M;
    } else {
      f.v = decay;
      f.u = f.v / s;
      f.strain = -slowness * decay;
      f.stress = M * f.strain;
    }
    return f;
  }
};

}  // namespace

ZenerBar::ZenerBar(std::string name, const ZenerBarParameters& parameters)
    : name_(std::move(name)), p_(parameters) {
  double glassy = p_.modulus;
  for (const double M : p_.branch_moduli)
    glassy += M;
  front_speed_ = std::sqrt(glassy / p_.density);
  const double A = p_.amplitude, omega = p_.angular_frequency;
  if (p_.signal != Signal::sine) signal_.push_back({A, 0});
  for (const double sign : {1.0, -1.0}) {
    const std::complex<double> i_omega(0, sign * omega);
    if (p_.signal == Signal::one_minus_cosine) signal_.push_back({-0.5 * A, i_omega});
    if (p_.signal != Signal::sine) continue;
    constexpr double binomial[4] = {1, -3, 3, -1};
    for (int n = 0; n < 4; ++n) {
      signal_.push_back(
          {std::complex<double>(0, -0.5 * sign * A * binomial[n]), i_omega - n * p_.ramp_rate});
    }
  }
}

template <class Real>
BarMotion ZenerBar::motion(double x, double t, int n_points) const {
  using Complex = std::complex<Real>;
  const Medium<Real> medium{p_, Real(front_speed_)};
  Four<Real> sum;
  const auto add_path = [&](Real d, Real sign_u, Real sign_stress) {
    const Real after = Real(t) - d / Real(front_speed_);  // s since the front came by
    if (!(after > 0)) return false;
    Four<Real> path;
    for (const Term& term : signal_) {
      const Complex a(term.amplitude), pole(term.exponent);
      if (term.exponent.imag() == 0) {
        path += talbot_sum(
            [&](Complex s) { return medium.path(s, d, sign_stress * sign_u) * (a / (s - pole)); },
            after, n_points);
        continue;
      }
      const Four<Real> steady = medium.path(pole, d, sign_stress * sign_u);
      path += steady * (a * std::exp(pole * after));
      path += talbot_sum(
          [&](Complex s) {
            return (medium.path(s, d, sign_stress * sign_u) - steady) * (a / (s - pole));
          },
          after, n_points);
    }
    sum += path * Complex(sign_u);
    return true;
  };
  if (p_.is_slab) {
    for (int n = 0;; ++n) {  // 1/cosh(kL) = 2 sum (-1)^n e^-(2n+1)kL
      const Real sign = n % 2 == 0 ? 1 : -1;
      const Real d = Real(2 * n) * Real(p_.length);
      const bool direct = add_path(d + Real(p_.length) - Real(x), sign, sign);
      add_path(d + Real(p_.length) + Real(x), -sign, sign);
      if (!direct) break;
    }
  } else {
    add_path(Real(x), 1, 1);
  }
  return {static_cast<double>(sum.u.real()), static_cast<double>(sum.v.real()),
          static_cast<double>(sum.strain.real()), static_cast<double>(sum.stress.real())};
}

template BarMotion ZenerBar::motion<double>(double, double, int) const;
template BarMotion ZenerBar::motion<long double>(double, double, int) const;

namespace {

/// k = omega sqrt(rho / M(i omega)) = omega/c - i alpha
std::complex<double> wave_number(const ZenerBarParameters& p) {
  const std::complex<double> s(0, p.angular_frequency);
  const Medium<double> medium{p, 1};
  return p.angular_frequency * std::sqrt(p.density / medium.modulus(s));
}

}  // namespace

double ZenerBar::phase_speed() const {
  return p_.angular_frequency / wave_number(p_).real();
}
double ZenerBar::attenuation() const {
  return -wave_number(p_).imag();
}

std::vector<std::string> ZenerBar::names() const {
  std::vector<std::string> all{name_, name_ + "_v", name_ + "_strain", name_ + "_stress"};
  if (p_.signal != Signal::step) {
    all.push_back(name_ + "_speed");
    all.push_back(name_ + "_attenuation");
  }
  return all;
}

/// Nodes one after the other are often at the same x.
void ZenerBar::values_at_all(std::span<const Vec3> X, double t, double* values) const {
  std::vector<double> here;
  for (size_t a = 0; a < X.size(); ++a) {
    if (a == 0 || X[a][0] != X[a - 1][0]) {
      const BarMotion now = motion<double>(X[a][0], t, 24);
      here = {now.u, now.v, now.strain, now.stress};
      if (p_.signal != Signal::step) {
        here.push_back(phase_speed());
        here.push_back(attenuation());
      }
    }
    values = std::copy(here.begin(), here.end(), values);
  }
}

std::vector<double> ZenerBar::values_at(const Vec3& X, double t) const {
  std::vector<double> values(names().size());
  values_at_all({&X, 1}, t, values.data());
  return values;
}

}  // namespace diptych::exact
