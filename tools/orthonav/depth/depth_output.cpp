#include "tools/orthonav/depth/depth_output.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/how_many.h"
#include "engine/io/atomic_file.h"
#include "engine/io/image_file.h"
#include "engine/io/ply_file.h"
#include "engine/io/range_picture.h"
#include "tools/orthonav/command.h"

namespace orthonav::tools {

double DepthArguments::cell_or_default_mm() const {
  constexpr double kDefaultCellMm = 5.0;
  return cell_mm.value_or(all ? kDefaultCellMm : 0.0);
}

int write_picture(const DepthArguments& arguments, DepthStream stream, std::int64_t index,
                  const DepthImage& range_mm) {
  const engine::RangePicture picture = engine::picture_of_ranges(range_mm);
  if (const Status s = engine::write_png(arguments.out, picture.image); !s) {
    return bad_input(s.error().message);
  }
  const nlohmann::ordered_json out = {{"stream", name_of(stream)},
                                      {"frame", index},
                                      {"white_mm", picture.white_mm},
                                      {"dark_mm", picture.dark_mm}};
  if (const Status s = arguments.json.write(out); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    std::printf("%s: frame %lld of %s, white %u mm, dark %u mm, black not measured\n",
                arguments.out.c_str(), static_cast<long long>(index), name_of(stream),
                picture.white_mm, picture.dark_mm);
  }
  return kDone;
}

int write_cloud(const DepthArguments& arguments, DepthStream stream,
                const engine::PointCloud& cloud, const CloudReport& report) {
  const std::size_t points = cloud.points_m().size();
  if (const Status s = engine::write_file(
          arguments.out,
          engine::ply_text(cloud.points_m(), "world, +y up, metres; orthonav depth"));
      !s) {
    return bad_input(s.error().message);
  }
  const nlohmann::ordered_json out = {{"stream", name_of(stream)},
                                      {"points", points},
                                      {"cell_mm", arguments.cell_or_default_mm()},
                                      {"frames_used", report.frames_used},
                                      {"frames_without_pose", report.frames_without_pose},
                                      {"frames_in_other_maps", report.frames_in_other_maps}};
  if (const Status s = arguments.json.write(out); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    std::printf("%s: %s of %s; frames: %lld used, %lld without a pose, %lld in other maps\n",
                arguments.out.c_str(), how_many(points, "point").c_str(), name_of(stream),
                static_cast<long long>(report.frames_used),
                static_cast<long long>(report.frames_without_pose),
                static_cast<long long>(report.frames_in_other_maps));
  }
  return points > 0 ? kDone : kNo;
}

}  // namespace orthonav::tools
