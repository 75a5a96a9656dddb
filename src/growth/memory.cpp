#include "sensory_growth/growth/memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensory_growth::growth {
namespace {

/// Values at labels that include the old ones, linear between those.
void resample(const std::vector<double>& old_labels, const SectionField& old_values, const std::vector<double>& labels,
              SectionField& values) {
  values.resize(labels.size());
  std::size_t above = 1;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    while (above + 1 < old_labels.size() && old_labels[above] < labels[i]) ++above;
    const double x = (labels[i] - old_labels[above - 1]) / (old_labels[above] - old_labels[above - 1]);
    values[i] = (1.0 - x) * old_values[above - 1] + x * old_values[above];
  }
}

/// Beyond it, what is made of it is no longer finite [-].
constexpr double kLargestSignal = 1e30;

bool isSignal(const SectionField& field) {
  const auto is_number = [](const Eigen::Vector2d& value) { return (value.array().abs() <= kLargestSignal).all(); };
  return std::all_of(field.begin(), field.end(), is_number);
}

/// Whether a sample can come after another, as far as both are looked at on their own.
bool canFollow(const MemorySample& before, const MemorySample& after) {
  if (after.time < before.time || after.labels.size() < before.labels.size()) return false;
  // A single sensor remains one.
  return (before.labels.size() == 1) == (after.labels.size() == 1);
}

bool isSample(const MemorySample& sample, std::size_t states) {
  const std::vector<double>& labels = sample.labels;
  const auto fits = [&](const SectionField& field) { return field.size() == labels.size() && isSignal(field); };
  const auto falls = [](double below, double above) { return !(below < above); };  // NaN does
  return std::isfinite(sample.time) && !labels.empty() && std::isfinite(labels.front()) &&
         std::isfinite(labels.back()) && std::adjacent_find(labels.begin(), labels.end(), falls) == labels.end() &&
         fits(sample.sensed) && sample.states.size() == states &&
         std::all_of(sample.states.begin(), sample.states.end(), fits);
}

}  // namespace

Memory::Memory(MemoryKernel kernel, BeforeStart before_start)
    : kernel_(std::move(kernel)), before_start_(before_start) {
  if (const auto fault = findFault(kernel_))
    throw std::invalid_argument("memory: " + fault->field + " " + fault->reason);
}

const SectionField& Memory::expect(double time, const std::vector<double>& labels, const SectionField& sensed) {
  return sense(time, labels, sensed, Side::before).states.front();
}

const SectionField& Memory::remember(double time, const std::vector<double>& labels, const SectionField& sensed) {
  const MemorySample& now = sense(time, labels, sensed, Side::after);
  const bool repeats = size_ > 0 && samples_[size_ - 1].time == now.time && samples_[size_ - 1].sensed == now.sensed;
  if (!repeats) ++size_;
  return now.states.front();
}

double Memory::nextJump(double time) const {
  const auto* pure = std::get_if<Delay>(&kernel_);
  if (pure && pure->time > 0.0) {
    for (std::size_t k = 0; k < size_; ++k) {
      const bool jumps = k > 0 ? samples_[k].time == samples_[k - 1].time : before_start_ == BeforeStart::zero;
      const double arrival = samples_[k].time + pure->time;
      if (jumps && arrival - time > kSameTime * std::abs(time)) return arrival;
    }
  }
  return std::numeric_limits<double>::infinity();
}

History Memory::history() const { return {samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(size_)}; }

void Memory::restore(History history) {
  const auto states = static_cast<std::size_t>(stateCount(kernel_));
  for (std::size_t k = 0; k < history.size(); ++k) {
    if (!isSample(history[k], states) || (k > 0 && !canFollow(history[k - 1], history[k]))) {
      throw std::invalid_argument("sample " + std::to_string(k) + " of a memory is none that this kernel keeps");
    }
  }
  samples_ = std::move(history);
  size_ = samples_.size();
}

void Memory::forgetTheOld() {
  if (size_ == 0) return;
  // One sample more than is looked back at: what was just before may be asked for.
  const double latest = samples_[size_ - 1].time;
  const double oldest_needed = latest - (1.0 + 1e-9) * lookBack(kernel_);
  const auto first_needed = std::find_if(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(size_ - 1),
                                         [&](const MemorySample& sample) { return sample.time >= oldest_needed; });
  if (first_needed - samples_.begin() < 2) return;
  const auto forgotten = first_needed - 1;
  size_ -= static_cast<std::size_t>(forgotten - samples_.begin());
  std::rotate(samples_.begin(), forgotten, samples_.end());
}

/// The new sample stands behind those that are kept.
const MemorySample& Memory::sense(double time, const std::vector<double>& labels, const SectionField& sensed,
                                  Side side) {
  if (samples_.size() == size_) samples_.emplace_back();
  MemorySample& now = samples_[size_];
  const bool goes_on = size_ == 0 || time - samples_[size_ - 1].time > kSameTime * std::abs(time);
  now.time = goes_on ? time : samples_[size_ - 1].time;
  now.labels = labels;
  now.sensed = sensed;

  times_.clear();
  for (std::size_t k = 0; k <= size_; ++k) times_.push_back(samples_[k].time);
  weigh(kernel_, times_, before_start_ == BeforeStart::constant ? 1.0 : 0.0, side, weights_);

  now.states.resize(static_cast<std::size_t>(stateCount(kernel_)));
  for (SectionField& state : now.states) state.assign(labels.size(), Eigen::Vector2d::Zero());
  for (std::size_t k = 0; k <= size_; ++k) add(samples_[k], samples_[k].sensed, weights_.samples[k], now);
  if (size_ > 0) {
    const MemorySample& latest = samples_[size_ - 1];
    for (std::size_t i = 0; i < latest.states.size(); ++i) {
      add(latest, latest.states[i], weights_.states.col(static_cast<Eigen::Index>(i)), now);
    }
  }
  return now;
}

/// Adds values at the labels of one sample to the states of another, which may have more labels.
void Memory::add(const MemorySample& from, const SectionField& values, const StateVector& weight, MemorySample& to) {
  if (weight.isZero(0.0)) return;
  const bool has_more = to.labels.size() > from.labels.size();
  if (has_more) resample(from.labels, values, to.labels, resampled_);
  const SectionField& now = has_more ? resampled_ : values;
  for (std::size_t s = 0; s < to.states.size(); ++s) {
    for (std::size_t i = 0; i < now.size(); ++i) to.states[s][i] += weight[static_cast<Eigen::Index>(s)] * now[i];
  }
}

}  // namespace sensory_growth::growth
