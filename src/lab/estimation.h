#pragma once
// Monte Carlo estimates of known expectations, and how their errors fall.

#include "core/statistics.h"
#include "lab/source.h"

#include <concepts>
#include <span>
#include <vector>

namespace candela {

/// One draw of an experiment.
struct Draw {
  double value;  ///< its expectation is estimated
  vec2 position; ///< where it is drawn in the experiment's picture
  bool hit;      ///< whether it counts as a hit
};

/// - draw: from the sampler's current sample, with Dimension::film.
/// - expected: the expectation, in closed form.
/// - standard_deviation: of one draw, in closed form.
template <class E>
concept Experiment = requires(const E& e, const Sampler& sampler) {
  { e.draw(sampler) } -> std::same_as<Draw>;
  { e.expected() } -> std::same_as<double>;
  { e.standard_deviation() } -> std::same_as<double>;
};

/// The estimate after `count` samples of each stream.
struct TracePoint {
  std::uint64_t count;
  double estimate;       ///< mean of the streams' estimates
  double rms_error;      ///< root of the mean of the streams' squared errors; with one stream its |error|
  double expected_error; ///< standard_deviation / sqrt(count), that of independent samples
};

/// The counts at which a trace has points: 1, 2, 3, …, then about four per power of two, including the
/// powers.
std::uint64_t next_trace_count(std::uint64_t count);

/// Runs an experiment on `streams` independent streams of `samples` samples each. A value: it can be copied,
/// and the result does not depend on the sizes of the steps.
template <Experiment E>
class Estimation {
public:
  Estimation(E experiment, SampleSource source, std::uint64_t samples, int streams = 1)
      : experiment_(std::move(experiment)), source_(source), samples_(samples),
        statistics_(static_cast<std::size_t>(streams)) {}

  const E& experiment() const { return experiment_; }
  const SampleSource& source() const { return source_; }
  std::uint64_t samples() const { return samples_; } ///< of each stream, at the end
  std::uint64_t done() const { return done_; }       ///< of each stream, so far
  bool finished() const { return done_ >= samples_; }
  int streams() const { return static_cast<int>(statistics_.size()); }

  /// Draws `count` more samples of each stream, or those that are left.
  void advance(std::uint64_t count) {
    std::uint64_t end = done_ + std::min(count, samples_ - done_);
    while (done_ < end) {
      std::uint64_t stop = std::min(next_trace_, end);
      for (int s = 0; s < streams(); ++s) run(s, stop);
      done_ = stop;
      if (done_ == next_trace_ || done_ == samples_) trace_.push_back(trace_point());
      if (done_ == next_trace_) next_trace_ = next_trace_count(done_);
    }
  }

  /// Repeats the draw of one sample.
  Draw replay(std::uint64_t sample, int stream = 0) const {
    Sampler sampler = source_.sampler();
    sampler.start(SampleSource::pixel(stream), static_cast<std::uint32_t>(sample));
    return experiment_.draw(sampler);
  }

  double estimate() const { return across_streams().mean(); }
  /// The standard error of estimate(). With one stream, that of independent samples with this variance, in
  /// practice an upper bound for stratified ones. With several streams, from the spread of their estimates,
  /// which is valid for every sampler.
  double standard_error() const {
    if (streams() == 1) return std::sqrt(statistics_[0].variance_of_mean());
    return std::sqrt(across_streams().variance_of_mean());
  }
  std::uint64_t hits() const { return hits_; } ///< of all streams
  std::uint64_t misses() const { return done_ * statistics_.size() - hits_; }
  std::span<const TracePoint> trace() const { return trace_; }

private:
  void run(int stream, std::uint64_t stop) {
    RunningStatistics& statistics = statistics_[static_cast<std::size_t>(stream)];
    Sampler sampler = source_.sampler();
    for (std::uint64_t i = done_; i < stop; ++i) {
      sampler.start(SampleSource::pixel(stream), static_cast<std::uint32_t>(i));
      Draw draw = experiment_.draw(sampler);
      statistics.add(draw.value);
      hits_ += draw.hit;
    }
  }
  RunningStatistics across_streams() const {
    RunningStatistics means;
    for (const RunningStatistics& stream : statistics_) means.add(stream.mean());
    return means;
  }
  TracePoint trace_point() const {
    double squares = 0, expected = experiment_.expected();
    for (const RunningStatistics& stream : statistics_)
      squares += (stream.mean() - expected) * (stream.mean() - expected);
    return {done_, estimate(), std::sqrt(squares / static_cast<double>(statistics_.size())),
            experiment_.standard_deviation() / std::sqrt(static_cast<double>(done_))};
  }

  E experiment_;
  SampleSource source_;
  std::uint64_t samples_, done_ = 0, next_trace_ = 1, hits_ = 0;
  std::vector<RunningStatistics> statistics_; ///< of each stream's values
  std::vector<TracePoint> trace_;
};

} // namespace candela
