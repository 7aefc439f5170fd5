// The state of a surface as a grid.

#include "Support/AnalyticShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include "NarrowBandGrid.h"
#include "SavedGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

using namespace activesurface;

namespace TestSavedState
{

TEST(TestSavedState, StateComesBackAndGoesOnToTheSameBits)
{
  const auto band = std::make_shared<NarrowBand>(VoxelSizeOf(32));
  StartOn(*band, MakeBall(CentreA, 0.4));
  ShapeTarget target(MakeBall(CentreB, 0.6));
  band->Advance(0.1, MakeMotion(1.0, 0.01), target);
  HistoryRow row;
  row.Time = 1.0 / 3.0;
  row.Area = 1e-300;
  row.EulerCharacteristic = -4;
  row.Outside = 1.0 / 7.0;
  row.Event = "2 parts merge";
  const SavedState saved = ReadSavedGrid(*MakeSavedGrid({ band, {}, 2.5, { HistoryRow(), row } }));
  EXPECT_EQ(saved.Time, 2.5) << "pipeline time";
  ASSERT_EQ(saved.History.size(), 2u);
  EXPECT_EQ(saved.History[1].Time, row.Time) << "not rounded";
  EXPECT_EQ(saved.History[1].Area, row.Area) << "not rounded";
  EXPECT_EQ(saved.History[1].EulerCharacteristic, -4);
  EXPECT_EQ(saved.History[1].Outside, row.Outside) << "not rounded";
  EXPECT_EQ(saved.History[1].Event, row.Event);
  EXPECT_EQ(saved.Band->GetTime(), band->GetTime()) << "time of the band";
  EXPECT_TRUE(AreIdentical(*saved.Band, *band));

  const std::unique_ptr<NarrowBand> copy = FromGrid(*ToGrid(*saved.Band));
  band->Advance(0.3, MakeMotion(1.0, 0.01), target);
  copy->Advance(0.3, MakeMotion(1.0, 0.01), target);
  EXPECT_TRUE(AreIdentical(*copy, *band)) << "later";
}

// Older files have no Outside column.
TEST(TestSavedState, AFileWithoutTheShareOutsideIsRead)
{
  const auto band = std::make_shared<NarrowBand>(VoxelSizeOf(32));
  StartOn(*band, MakeBall(CentreA, 0.4));
  HistoryRow row;
  row.Event = "split";
  const openvdb::FloatGrid::Ptr grid = MakeSavedGrid({ band, {}, 0.0, { HistoryRow(), row } });
  grid->removeMeta("active_history_outside");
  const SavedState saved = ReadSavedGrid(*grid);
  ASSERT_EQ(saved.History.size(), 2u);
  EXPECT_TRUE(std::isnan(saved.History[0].Outside)) << saved.History[0].Outside;
  EXPECT_TRUE(std::isnan(saved.History[1].Outside)) << saved.History[1].Outside;
  EXPECT_EQ(saved.History[1].Event, "split");

  const SavedState again = ReadSavedGrid(*MakeSavedGrid(saved));
  EXPECT_TRUE(std::isnan(again.History[1].Outside)) << "written again";
  grid->insertMeta("active_history_outside", openvdb::StringMetadata("0x1p-3\n"));
  EXPECT_TRUE(Throws<std::runtime_error>([&] { ReadSavedGrid(*grid); }, "damaged")) << "a row less";
}

TEST(TestSavedState, AnEstimatedSpacingComesBack)
{
  const auto band = std::make_shared<NarrowBand>(VoxelSizeOf(32));
  StartOn(*band, MakeBall(CentreA, 0.4));
  const openvdb::FloatGrid::Ptr grid = MakeSavedGrid({ band, {}, 0.0, {}, 1.0 / 3.0 });
  EXPECT_EQ(ReadSavedGrid(*grid).Spacing, 1.0 / 3.0) << "not rounded";
  EXPECT_EQ(ReadSavedGrid(*MakeSavedGrid({ band, {}, 0.0, {} })).Spacing, 0.0) << "none";
  grid->insertMeta("active_spacing", openvdb::DoubleMetadata(-1.0));
  EXPECT_TRUE(Throws<std::runtime_error>([&] { ReadSavedGrid(*grid); }, "damaged"));
}

TEST(TestSavedState, ATimeOrOriginThatIsNotFiniteIsDamage)
{
  const auto band = std::make_shared<NarrowBand>(VoxelSizeOf(32));
  StartOn(*band, MakeBall(CentreA, 0.4));
  const SavedState state{ band, { 1.0, 2.0, 3.0 }, 0.5, {} };
  const auto isRefused = [&](const char* name, const openvdb::Metadata& bad)
  {
    const openvdb::FloatGrid::Ptr grid = MakeSavedGrid(state);
    grid->insertMeta(name, bad);
    return Throws<std::runtime_error>([&] { ReadSavedGrid(*grid); }, "time or origin is damaged");
  };
  EXPECT_TRUE(isRefused("active_pipeline_time", openvdb::DoubleMetadata(std::nan(""))));
  EXPECT_TRUE(isRefused("active_origin", openvdb::Vec3DMetadata({ 0.0, HUGE_VAL, 0.0 })));
}

TEST(TestSavedState, AnyOtherGridIsRefused)
{
  EXPECT_TRUE(Throws<std::runtime_error>([] { ReadSavedGrid(*openvdb::FloatGrid::create()); }, ""));
}

}
