#include "engine/phantom/phantom_file.h"

#include <numbers>

#include "engine/io/json_document.h"

namespace orthonav::engine {
namespace {

double length(const JsonNode& node, const char* key) { return node.number(key) * 1e-3; }

double size(const JsonNode& node, const char* key) {
  const double value = length(node, key);
  if (!(value > 0.0)) {
    node.refuse(key, "must be greater than 0");
  }
  return value;
}

double angle(const JsonNode& node, const char* key) {
  return node.number(key) * std::numbers::pi / 180.0;
}

void read_body(const JsonNode& level, VertebraMorphometry& m) {
  const JsonNode body = level.child("body");
  m.upper_width_m = size(body, "upper_width");
  m.lower_width_m = size(body, "lower_width");
  m.upper_depth_m = size(body, "upper_depth");
  m.lower_depth_m = size(body, "lower_depth");
  m.anterior_height_m = size(body, "anterior_height");
  m.posterior_height_m = size(body, "posterior_height");
  const JsonNode canal = level.child("canal");
  m.canal_width_m = size(canal, "width");
  m.canal_depth_m = size(canal, "depth");
  const JsonNode disc = level.child("disc");
  m.disc_height_m = size(disc, "height");
  m.disc_wedge_rad = angle(disc, "wedge_deg");
}

void read_pedicle_and_processes(const JsonNode& level, VertebraMorphometry& m) {
  const JsonNode pedicle = level.child("pedicle");
  m.pedicle_width_m = size(pedicle, "width");
  m.pedicle_height_m = size(pedicle, "height");
  m.pedicle_transverse_rad = angle(pedicle, "transverse_deg");
  m.pedicle_sagittal_rad = angle(pedicle, "sagittal_deg");
  const JsonNode transverse = level.child("transverse_process");
  m.transverse_span_m = size(transverse, "span");
  m.transverse_height_m = size(transverse, "height");
  m.transverse_thickness_m = size(transverse, "thickness");
  m.transverse_back_m = length(transverse, "back");
  m.transverse_rise_m = length(transverse, "rise");
  const JsonNode spinous = level.child("spinous_process");
  m.spinous_length_m = size(spinous, "length");
  m.spinous_height_m = size(spinous, "height");
  m.spinous_thickness_m = size(spinous, "thickness");
  m.spinous_drop_m = length(spinous, "drop");
  m.spinous_deviation_m = length(spinous, "deviation");
}

void read_facets(const JsonNode& level, VertebraMorphometry& m) {
  const JsonNode superior = level.child("superior_facets");
  m.superior_distance_m = size(superior, "distance");
  m.superior_height_m = size(superior, "height");
  m.superior_width_m = size(superior, "width");
  m.superior_rotation_rad = angle(superior, "turn_deg");
  const JsonNode inferior = level.child("inferior_facets");
  m.inferior_distance_m = size(inferior, "distance");
  m.inferior_height_m = size(inferior, "height");
  m.inferior_width_m = size(inferior, "width");
  m.inferior_rotation_rad = angle(inferior, "turn_deg");
  m.inferior_drop_m = size(inferior, "drop");
}

}  // namespace

Result<PhantomParameters> phantom_parameters(std::string_view json, const std::string& name) {
  const Result<JsonDocument> document = JsonDocument::parse(json, name);
  if (!document) {
    return document.error();
  }
  const JsonNode root = document->root();
  PhantomParameters parameters;
  parameters.name = root.text("name");
  for (const JsonNode& level : root.list("levels")) {
    VertebraMorphometry m;
    m.label = level.text("label");
    read_body(level, m);
    read_pedicle_and_processes(level, m);
    read_facets(level, m);
    parameters.levels.push_back(m);
  }
  const JsonNode screw = root.child("screw");
  parameters.screw_length_m = size(screw, "length");
  parameters.screw_diameter_m = size(screw, "diameter");
  if (Status status = document->status(); !status) {
    return status.error();
  }
  return parameters;
}

}  // namespace orthonav::engine
