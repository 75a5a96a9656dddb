#include "sensory_growth/batch/frame_files.h"

#include <gmock/gmock.h>

#include <cmath>

#include "batch/command_line.h"
#include "sensory_growth/batch/bad_input.h"

namespace sensory_growth::batch::testing {
namespace {

using ::testing::ElementsAre;

/// Two elements and three vertices, all numbers exact in binary.
OrganState shoot(std::uint64_t step) {
  OrganState state;
  state.organ = "shoot";
  state.step_index = step;
  state.growth_time = 60.0 * static_cast<double>(step);
  state.positions.resize(3);
  state.positions[1].z = 0.5;
  state.positions[2].x = -0.25;
  state.positions[2].z = 0.875;
  state.curvature.resize(2);
  state.curvature[1].x = 3.0;
  state.curvature[1].y = -4.0;
  state.curvature[1].z = 100.0;  // twist is no part of it
  state.growth_rate = {0.0, 0.5};
  state.radius = {0.5, 0.25};
  state.age = {8.0, 2.0};
  return state;
}

TEST(VertexFields, AreMeansOfTheNeighbouringElements) {
  const VertexFields fields = vertexFields(shoot(0));
  EXPECT_THAT(fields.curvature, ElementsAre(0.0, 5.0, 5.0));
  EXPECT_THAT(fields.growth_rate, ElementsAre(0.0, 0.25, 0.5));
  EXPECT_THAT(fields.radius, ElementsAre(0.5, 0.375, 0.25));
  EXPECT_THAT(fields.age, ElementsAre(8.0, 5.0, 2.0));
}

TEST(VertexFields, OfOneElementAreItsOwn) {
  OrganState state;
  state.positions.resize(2);
  state.curvature.resize(1);
  state.growth_rate = state.radius = state.age = {0.5};
  EXPECT_THAT(vertexFields(state).radius, ElementsAre(0.5, 0.5));
  EXPECT_THAT(vertexFields(state).curvature, ElementsAre(0.0, 0.0));
}

// The layout of legacy files, from the VTK file formats document.
TEST(ToVtk, IsALegacyPolyline) {
  EXPECT_EQ(toVtk(shoot(2)),
            "# vtk DataFile Version 3.0\n"
            "shoot, step 2, growth time [s] 120\n"
            "ASCII\n"
            "DATASET POLYDATA\n"
            "POINTS 3 double\n"
            "0 0 0\n0 0 0.5\n-0.25 0 0.875\n"
            "LINES 1 4\n"
            "3 0 1 2\n"
            "POINT_DATA 3\n"
            "SCALARS curvature double 1\nLOOKUP_TABLE default\n0\n5\n5\n"
            "SCALARS growth_rate double 1\nLOOKUP_TABLE default\n0\n0.25\n0.5\n"
            "SCALARS radius double 1\nLOOKUP_TABLE default\n0.5\n0.375\n0.25\n"
            "SCALARS age double 1\nLOOKUP_TABLE default\n8\n5\n2\n");
}

class FrameFilesTest : public InFolder {};

TEST_F(FrameFilesTest, HaveEveryWantedStepOfTheEpoch) {
  FrameFiles files({path("csv"), path("vtk/new"), 2}, {"shoot"}, 1);
  OrganState earlier = shoot(0);
  earlier.positions[0].x = 7.0;
  files.write(earlier);  // of epoch 0
  for (std::uint64_t step = 0; step <= 4; ++step) {
    OrganState state = shoot(step);
    state.epoch = 1;
    files.write(state);
  }
  files.close();
  std::string table = "frame,x,y,z\n";
  for (const std::string frame : {"0,", "2,", "4,"}) {
    table += frame + "0,0,0\n" + frame + "0,0,0.5\n" + frame + "-0.25,0,0.875\n";
  }
  EXPECT_EQ(textOf(path("csv/shoot.csv")), table);
  EXPECT_EQ(textOf(path("vtk/new/shoot_000004.vtk")), toVtk(shoot(4)));
  EXPECT_FALSE(std::filesystem::exists(path("vtk/new/shoot_000003.vtk")));
  EXPECT_EQ(textOf(path("vtk/new/shoot.vtk.series")),
            "{\"file-series-version\": \"1.0\", \"files\": [\n"
            "{\"name\": \"shoot_000000.vtk\", \"time\": 0},\n"
            "{\"name\": \"shoot_000002.vtk\", \"time\": 120},\n"
            "{\"name\": \"shoot_000004.vtk\", \"time\": 240}\n]}\n");
}

TEST_F(FrameFilesTest, HoldNumbersToTheLastBit) {
  OrganState state = shoot(0);
  const double third = 1.0 / 3.0;
  state.positions[2].y = third;
  FrameFiles files({path("csv"), "", 1}, {"shoot"});
  files.write(state);
  files.close();
  const std::string table = textOf(path("csv/shoot.csv"));
  const std::string last_line = table.substr(table.rfind('\n', table.size() - 2) + 1);
  EXPECT_EQ(std::stod(last_line.substr(std::string("0,-0.25,").size())), third);
}

TEST_F(FrameFilesTest, DoNotReplaceOthers) {
  write("shoot.csv", "precious");
  EXPECT_THROW(FrameFiles({folder_, "", 1}, {"shoot"}), BadInput);
  EXPECT_EQ(textOf(path("shoot.csv")), "precious");
  write("shoot.vtk.series", "precious");
  EXPECT_THROW(FrameFiles({"", folder_, 1}, {"shoot"}), BadInput);
  EXPECT_THROW(FrameFiles({path("shoot.csv"), "", 1}, {"root"}), BadInput);  // no folder
  FrameFiles later({folder_, "", 1}, {"root"});
  EXPECT_THROW(later.write(shoot(0)), BadInput);
  EXPECT_EQ(textOf(path("shoot.csv")), "precious");
}

TEST_F(FrameFilesTest, SayWhenTheDiskTakesNothing) {
  FrameFiles files({"", path("vtk"), 1}, {"shoot"});
  std::filesystem::remove_all(path("vtk"));
  EXPECT_THROW(files.write(shoot(0)), std::runtime_error);
}

}  // namespace
}  // namespace sensory_growth::batch::testing
