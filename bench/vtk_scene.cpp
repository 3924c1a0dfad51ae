#include "bench/vtk_scene.h"

#include <vtkActor.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>

#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "render/float3.h"
#include "render/frame/frame_items.h"
#include "render/projection.h"

namespace orthonav::bench {
namespace {

using render::Float3;

vtkNew<vtkPoints> points_of(std::span<const Float3> places) {
  vtkNew<vtkPoints> points;
  for (const Float3 p : places) {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  return points;
}

void add_actor(vtkPolyData& data, const render::Colour& colour, vtkRenderer& renderer,
               const render::Matrix4& place = render::kIdentity) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&data);
  mapper->StaticOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetOpacity(colour.a);
  actor->GetProperty()->BackfaceCullingOn();
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix->SetElement(row, column, place[column][row]);
    }
  }
  actor->SetUserMatrix(matrix);
  renderer.AddActor(actor);
}

void add_mesh(const render::MeshItem& item, vtkRenderer& renderer) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(item.mesh->positions));
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const Float3 n : item.mesh->normals) {
    normals->InsertNextTuple3(n.x, n.y, n.z);
  }
  data->GetPointData()->SetNormals(normals);
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < item.mesh->indices.size(); i += 3) {
    triangles->InsertNextCell(
        {item.mesh->indices[i], item.mesh->indices[i + 1], item.mesh->indices[i + 2]});
  }
  data->SetPolys(triangles);
  add_actor(*data, item.colour, renderer, item.world_from_model);
}

/// As a six-sided tube, made once: VTK's own lines have a width in pixels only.
void add_line(const render::LineItem& item, vtkRenderer& renderer) {
  std::vector<Float3> places = item.points;
  if (item.closed) {
    places.push_back(places.front());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(places));
  vtkNew<vtkCellArray> line;
  line->InsertNextCell(static_cast<int>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    line->InsertCellPoint(static_cast<vtkIdType>(i));
  }
  data->SetLines(line);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(data);
  tube->SetRadius(0.5 * item.width_m);
  tube->SetNumberOfSides(6);
  tube->CappingOn();
  tube->Update();
  add_actor(*tube->GetOutput(), item.colour, renderer);
}

void add_triangle(const render::TriangleItem& item, vtkRenderer& renderer) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(item.corners));
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({0, 1, 2});
  cells->InsertNextCell({0, 2, 1});
  data->SetPolys(cells);
  add_actor(*data, item.colour, renderer);
}

void add_text(const render::TextItem& item, const render::View& view, vtkRenderer& renderer) {
  const render::Head head = render::head_of({view});
  const render::Matrix4 place = render::world_from_caps(item, head);
  const Float3 at(place[3]);
  const float cap_m = render::length(Float3(place[1]));
  const float tall = cap_m / render::length(at - head.position) / (view.tan_up + view.tan_down);
  std::string text;
  for (const render::TextRun& run : item.runs) {
    text += run.text;
  }
  vtkNew<vtkBillboardTextActor3D> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(at.x, at.y, at.z);
  // A letter's body is about 1.4 times as tall as its capitals; VTK counts points at 72 dots an
  // inch.
  const auto size = static_cast<int>(std::lround(1.4 * tall * renderer.GetSize()[1]));
  actor->GetTextProperty()->SetFontSize(std::max(size, 6));
  if (!item.runs.empty()) {
    const render::Colour& colour = item.runs.front().colour;
    actor->GetTextProperty()->SetColor(colour.r, colour.g, colour.b);
  }
  actor->GetTextProperty()->SetJustificationToCentered();
  renderer.AddActor(actor);
}

}  // namespace

void add_scene(const render::Scene& scene, const render::View& view, vtkRenderer& renderer) {
  for (const render::MeshItem& item : scene.meshes) {
    add_mesh(item, renderer);
  }
  for (const render::LineItem& item : scene.lines) {
    add_line(item, renderer);
  }
  for (const render::TriangleItem& item : scene.triangles) {
    add_triangle(item, renderer);
  }
  for (const render::TextItem& item : scene.texts) {
    add_text(item, view, renderer);
  }
}

void set_camera(const render::View& view, vtkRenderer& renderer) {
  const render::Matrix4 world_from_eye = render::rigid_inverse(view.eye_from_world);
  const auto up = world_from_eye[1];
  const auto back = world_from_eye[2];
  const auto at = world_from_eye[3];
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.SetPosition(at.x, at.y, at.z);
  camera.SetFocalPoint(at.x - back.x, at.y - back.y, at.z - back.z);
  camera.SetViewUp(up.x, up.y, up.z);
  camera.SetViewAngle(2 * std::atan(view.tan_up) * 180 / std::numbers::pi);
  camera.SetClippingRange(0.02, 10);
}

}  // namespace orthonav::bench
