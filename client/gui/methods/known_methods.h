#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/gui/methods/method_rows.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/views.pb.h"

namespace metamer::gui {

/// What is known of the methods on one scene, and which of them is used.
class KnownMethods {
 public:
  /// The predictions of a job that explained `scene`.
  static KnownMethods predicted(const v1::Scene& scene, const v1::Plan& plan);
  /// Of a trade on `scene`, whatever its method is.
  static KnownMethods measured(const v1::Scene& scene,
                               std::shared_ptr<const client::Tradeoff> tradeoff);

  const QList<MethodRow>& rows() const { return rows_; }
  /// Null: they are predictions.
  std::shared_ptr<const client::Tradeoff> tradeoff() const { return tradeoff_; }
  /// Whether they hold of a scene: it is the same but for its method and goal.
  bool hold_of(const v1::Scene& scene) const;
  /// Whether the scene's goal is one whose choice the server has said, or there is no goal.
  bool knows_choice(const v1::Settings& settings) const;
  /// What the server chose for its goal.
  void set_choice(const v1::Settings& settings, const v1::Method& choice);

  /// Marks the method that a scene with these settings is rendered by.
  void mark_used(const v1::Settings& settings);
  /// What came of a job of a scene of which they hold. Other methods' are passed over, as are those
  /// that follow.
  void add_job(const QString& from, const v1::Plan& plan, const v1::Finished& finished);
  /// What a complete frame of a view took, reckoned up to the picture's size and samples. A job's
  /// own figures stay.
  void add_frame(const v1::Plan& plan, const v1::Frame& frame);

  /// What they are, of how many pixels, and what is used: a few sentences.
  QString heading() const;

 private:
  explicit KnownMethods(const v1::Scene& scene);

  QList<MethodRow> rows_;
  std::string part_;       ///< comparable_part of the scene.
  v1::Settings settings_;  ///< Of the scene, defaults filled in.
  v1::Settings goal_;      ///< The goal alone that `choice_` is of; none: of no goal.
  v1::Method choice_;
  QString source_, used_;
  std::shared_ptr<const client::Tradeoff> tradeoff_;
};

}  // namespace metamer::gui
