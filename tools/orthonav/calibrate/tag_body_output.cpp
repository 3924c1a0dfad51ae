#include "tools/orthonav/calibrate/tag_body_output.h"

#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/io/json_writer.h"
#include "tools/orthonav/calibrate/calibrate.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {

nlohmann::ordered_json tag_body_json(const Result<nav::TagBody>& body, std::size_t pairs) {
  nlohmann::ordered_json out = {{"pairs", pairs}};
  if (!body) {
    add_judgement({nav::Verdict::kFail, body.error().message}, out);
    return out;
  }
  out["pairs_used"] = body->pairs;
  out["rms_px"] = body->rms_px;
  out["outlier_share"] = body->outlier_fraction;
  for (const nav::BodyTag& tag : body->tags) {
    out["tags"].push_back({{"family", tag.definition.family},
                           {"id", tag.definition.id},
                           {"size_mm", tag.definition.size_m * 1e3},
                           {"measured_size_mm", tag.definition.size_m * tag.size_ratio * 1e3},
                           {"pose", engine::rows_mm(tag.marker_from_tag.row_major())},
                           {"pairs", tag.pairs},
                           {"sigma_mm", tag.sigma_m * 1e3},
                           {"sigma_deg", tag.sigma_rad * kDegreesPerRadian}});
  }
  add_judgement(body->judgement, out);
  return out;
}

void print_tag_body(const nav::TagBody& body) {
  print_text("%zu pairs, residual %.3f px RMS, %.1f %% of the corners left out\n", body.pairs,
             body.rms_px, 100 * body.outlier_fraction);
  for (const nav::BodyTag& tag : body.tags) {
    const Vec3 at_mm = tag.marker_from_tag.translation() * 1e3;
    print_text(
        "%s id %d: at %.3f %.3f %.3f mm, known to %.3f mm and %.3f°; seen in %zu pairs, "
        "edges measure %.2f mm\n",
        tag.definition.family.c_str(), tag.definition.id, at_mm.x, at_mm.y, at_mm.z,
        tag.sigma_m * 1e3, tag.sigma_rad * kDegreesPerRadian, tag.pairs,
        tag.definition.size_m * tag.size_ratio * 1e3);
  }
  print_judgement(body.judgement);
}

}  // namespace orthonav::tools
