#include "libguide/bsdf/bsdf.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

template <typename L>
constexpr bool kOnlyDelta = std::is_same_v<L, Conductor> || std::is_same_v<L, Dielectric> ||
                            std::is_same_v<L, ThinDielectric>;
template <typename L>
constexpr bool kTransmissive = std::is_same_v<L, Dielectric> || std::is_same_v<L, ThinDielectric> ||
                               std::is_same_v<L, RoughDielectric>;

// Calls f(lobe) with the concrete type.
template <typename F>
auto with(const Lobe& lobe, const F& f) {
  return std::visit(f, lobe);
}

bool is_transmissive(const Lobe& lobe) {
  return with(lobe, []<typename L>(const L&) { return kTransmissive<L>; });
}

EvalPdf evaluate_lobe(const Lobe& lobe, const Vec3& wo, const Vec3& wi) {
  return with(lobe, [&](const auto& l) -> EvalPdf {
    if constexpr (requires { l.evaluate(wo, wi); })
      return l.evaluate(wo, wi);
    else
      return {l.eval(wo, wi), l.pdf(wo, wi)};
  });
}

// Index chosen by u from unnormalised probabilities, and u stretched for use within the choice.
struct Pick {
  int index = -1;
  float prob = 0, u = 0;
};

Pick pick(const float* probs, int count, float sum, float u) {
  float at = u * sum;
  Pick result;
  for (int i = 0; i < count; ++i) {
    if (!(probs[i] > 0)) continue;
    result = {i, probs[i] / sum, std::clamp(at / probs[i], 0.0f, kOneMinusEpsilon)};
    if (at < probs[i]) break;
    at -= probs[i];
  }
  return result;
}

}  // namespace

// Unnormalised probabilities of the delta and the smooth part of each lobe.
struct Bsdf::Choice {
  float delta[kMaxLobes], smooth[kMaxLobes];
  float delta_sum = 0, smooth_sum = 0;
};

Bsdf::Choice Bsdf::choose(const Vec3& wo) const {
  Choice choice;
  for (int i = 0; i < count_; ++i) {
    const bool lit = wo.z() > 0 || is_transmissive(lobes_[i]);
    const float prob = with(lobes_[i], [&](const auto& l) { return l.delta_prob(wo); });
    const float importance = lit ? importance_[i] : 0;
    choice.delta_sum += choice.delta[i] = importance * prob;
    choice.smooth_sum += choice.smooth[i] = importance * (1 - prob);
  }
  return choice;
}

EvalPdf Bsdf::evaluate(const Choice& choice, const Vec3& wo, const Vec3& wi) const {
  EvalPdf sum;
  if (!(choice.smooth_sum > 0)) return sum;
  for (int i = 0; i < count_; ++i) {
    if (!(choice.smooth[i] > 0)) continue;
    const EvalPdf e = evaluate_lobe(lobes_[i], wo, wi);
    sum.value += weights_[i] * e.value;
    sum.pdf += choice.smooth[i] / choice.smooth_sum * e.pdf;
  }
  return sum;
}

EvalPdf Bsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (count_ != 1) return evaluate(choose(wo), wo, wi);
  EvalPdf e = evaluate_lobe(lobes_[0], wo, wi);
  e.value *= weights_[0];
  return e;
}

Color Bsdf::eval(const Vec3& wo, const Vec3& wi) const {
  Color sum = Color::Zero();
  for (int i = 0; i < count_; ++i)
    sum += weights_[i] * with(lobes_[i], [&](const auto& l) { return l.eval(wo, wi); });
  return sum;
}

std::optional<BsdfSample> Bsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
  if (count_ == 1) {
    std::optional<BsdfSample> s =
        with(lobes_[0], [&](const auto& l) { return l.sample(wo, u, u2); });
    if (s) s->weight *= weights_[0];
    return s;
  }
  const Choice choice = choose(wo);
  const Pick chosen = pick(choice.smooth, count_, choice.smooth_sum, u);
  if (chosen.index < 0) return std::nullopt;
  std::optional<BsdfSample> s =
      with(lobes_[chosen.index], [&](const auto& l) { return l.sample(wo, chosen.u, u2); });
  if (!s) return std::nullopt;
  const EvalPdf e = evaluate(choice, wo, s->wi);
  if (!(e.pdf > 0)) return std::nullopt;
  return BsdfSample{s->wi, e.value / e.pdf, e.pdf, s->eta};
}

float Bsdf::pdf(const Vec3& wo, const Vec3& wi) const {
  if (count_ == 1) return with(lobes_[0], [&](const auto& l) { return l.pdf(wo, wi); });
  const Choice choice = choose(wo);
  if (!(choice.smooth_sum > 0)) return 0;
  float sum = 0;
  for (int i = 0; i < count_; ++i)
    if (choice.smooth[i] > 0)
      sum += choice.smooth[i] * with(lobes_[i], [&](const auto& l) { return l.pdf(wo, wi); });
  return sum / choice.smooth_sum;
}

float Bsdf::delta_prob(const Vec3& wo) const {
  if (count_ == 1) return with(lobes_[0], [&](const auto& l) { return l.delta_prob(wo); });
  const Choice choice = choose(wo);
  const float sum = choice.delta_sum + choice.smooth_sum;
  return sum > 0 ? choice.delta_sum / sum : 0;
}

std::optional<BsdfSample> Bsdf::sample_delta(const Vec3& wo, float u) const {
  Pick chosen{0, 1, u};
  if (count_ != 1) {
    const Choice choice = choose(wo);
    chosen = pick(choice.delta, count_, choice.delta_sum, u);
    if (chosen.index < 0) return std::nullopt;
  }
  std::optional<BsdfSample> s =
      with(lobes_[chosen.index], [&](const auto& l) { return l.sample_delta(wo, chosen.u); });
  if (!s) return std::nullopt;
  s->weight *= weights_[chosen.index] / chosen.prob;
  s->pdf *= chosen.prob;
  return s;
}

Color Bsdf::mean_reflectance() const {
  Color sum = Color::Zero();
  for (int i = 0; i < count_; ++i)
    sum += weights_[i] * with(lobes_[i], [](const auto& l) { return l.mean_reflectance(); });
  return sum;
}

Color Bsdf::straight_transmission(const Vec3& wo) const {
  Color sum = Color::Zero();
  for (int i = 0; i < count_; ++i)
    if (const ThinDielectric* pane = std::get_if<ThinDielectric>(&lobes_[i]))
      sum += weights_[i] * pane->straight_transmission(wo);
  return sum;
}

bool Bsdf::has_smooth() const {
  for (int i = 0; i < count_; ++i)
    if (with(lobes_[i], []<typename L>(const L&) { return !kOnlyDelta<L>; })) return true;
  return false;
}

bool Bsdf::smooth_transmissive() const {
  for (int i = 0; i < count_; ++i)
    if (std::holds_alternative<RoughDielectric>(lobes_[i])) return true;
  return false;
}

SideShares Bsdf::side_shares(const Vec3& wo) const {
  SideShares sum;
  for (int i = 0; i < count_; ++i) {
    const RoughDielectric* glass = std::get_if<RoughDielectric>(&lobes_[i]);
    const SideShares s =
        glass ? glass->side_shares(wo)
              : SideShares{
                    luminance(with(lobes_[i], [](const auto& l) { return l.mean_reflectance(); }))};
    sum.reflected += weights_[i] * s.reflected;
    sum.transmitted += weights_[i] * s.transmitted;
  }
  return sum;
}

float Bsdf::relative_eta(const Vec3& wo, const Vec3& wi) const {
  if (wo.z() * wi.z() >= 0) return 1;
  for (int i = 0; i < count_; ++i)
    if (const RoughDielectric* glass = std::get_if<RoughDielectric>(&lobes_[i]))
      return wo.z() > 0 ? glass->eta : 1 / glass->eta;
  return 1;
}

void Bsdf::scale(float factor) {
  for (int i = 0; i < count_; ++i) weights_[i] *= factor;
}

int Bsdf::next() const {
  if (count_ == kMaxLobes)
    fail("a blend mixes more than {} materials at one point: nest fewer blends", kMaxLobes);
  return count_;
}

// The importance of a lone lobe is never asked for.
void Bsdf::finish(float weight) {
  weights_[count_++] = weight;
  for (int i = count_ == 2 ? 0 : count_ - 1; count_ > 1 && i < count_; ++i)
    importance_[i] = weights_[i] *
                     luminance(with(lobes_[i], [](const auto& l) { return l.mean_reflectance(); }));
}

}  // namespace waylight
