#include "cli/map_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "cli/plan_words.h"
#include "cli/profile_picture.h"
#include "core/medium.h"

namespace grimaldi {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// A plan with one radio transmitter and a grid of nx × ny cells of 5 m with its south-west corner at (−10, 20).
Plan small_plan(std::size_t nx, std::size_t ny) {
  Plan plan;
  plan.frequency = {3.5e9};
  plan.grid.nx = nx;
  plan.grid.ny = ny;
  plan.grid.x0 = -10;
  plan.grid.y0 = 20;
  plan.grid.cell = 5;
  plan.grid.z = 1.5;
  Transmitter mast;
  mast.name = "mast";
  mast.position = {1e6, 0, 10};  // off the map: no marker covers a pixel under test
  mast.power = {30};
  plan.request.transmitters = {mast};
  plan.request.coverage.emplace();
  return plan;
}

Result with_gains(std::vector<double> gains) {
  Result result;
  result.coverage.emplace();
  for (const double gain : gains) result.coverage->inside_fraction.push_back(std::isnan(gain) ? 1 : 0);
  result.coverage->path_gain = std::move(gains);
  return result;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

unsigned big_endian(const std::string& bytes, std::size_t at) {
  unsigned value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// Colour in the middle of a cell.
Colour cell_colour(const MapPicture& picture, std::size_t cell) {
  const Vec3 centre = picture.frame.grid.centre(cell);
  return picture.canvas.pixel(int(picture.frame.x(centre.x)), int(picture.frame.y(centre.y)));
}

TEST(RoundTicks, AreTheFinestMultiplesOfOneTwoFive) {
  const Ticks ticks = round_ticks({-752, 748}, 9);
  EXPECT_EQ(ticks.step, 200);
  EXPECT_EQ(ticks.at, (std::vector<double>{-600, -400, -200, 0, 200, 400, 600}));
  EXPECT_EQ(round_ticks({-170, -80}, 16).step, 10);
  EXPECT_EQ(round_ticks({0, 1}, 6).at, (std::vector<double>{0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
}

TEST(RoundTicks, StayRoundWithinAnyRange) {
  for (const double size : {1e-6, 0.03, 0.7, 1.0, 7.3, 99.0, 1.23e5}) {
    for (const double low : {-3.7 * size, 0.0, 5.3e4 * size}) {
      for (int most = 2; most < 30; ++most) {
        const Ticks ticks = round_ticks({low, low + size}, most);
        ASSERT_LE(ticks.at.size(), std::size_t(most));
        const double mantissa = ticks.step / std::pow(10, std::floor(std::log10(ticks.step) + 1e-9));
        // 1e-9: the mantissa is recovered by a logarithm and a power, each good to a few ulp.
        EXPECT_TRUE(std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 || std::abs(mantissa - 5) < 1e-9);
        for (const double at : ticks.at) {
          // A tick at an end of the range may pass it by the rounding that round_ticks allows, 1e-9 of a step.
          EXPECT_GE(at, low - 2e-9 * ticks.step);
          EXPECT_LE(at, low + size + 2e-9 * ticks.step);
        }
      }
    }
  }
}

TEST(NumberText, HasTrueMinusSignsAndThousands) {
  EXPECT_EQ(number_text(-12.34, 1), "−12.3");
  EXPECT_EQ(number_text(-0.04, 1), "0.0");  // no minus before a zero
  EXPECT_EQ(number_text(1234, 0), "1234");
  EXPECT_EQ(number_text(12345, 0), "12\u2009345");
  EXPECT_EQ(number_text(-1000000, 0), "−1\u2009000\u2009000");
  EXPECT_EQ(number_text(123456.5, 1), "123\u2009456.5");
  EXPECT_EQ(tick_text(0.3, 0.1), "0.3");
  EXPECT_EQ(tick_text(-400, 200), "−400");
}

TEST(ColourScale, IsViridis) {
  EXPECT_EQ(colour_of(-90, {-90, -30}), (Colour{68, 1, 84}));     // 0x440154, the published ends
  EXPECT_EQ(colour_of(-30, {-90, -30}), (Colour{253, 231, 37}));  // 0xFDE725
  EXPECT_EQ(colour_of(-200, {-90, -30}), colour_of(-90, {-90, -30}));
  EXPECT_EQ(colour_of(0, {-90, -30}), colour_of(-30, {-90, -30}));
  // Entries of the published table far from the control points; 7 of 255 is the bound that the header states.
  const struct {
    int entry, red, green, blue;
  } published[] = {{25, 72, 36, 117}, {76, 53, 95, 141}, {128, 33, 145, 140}, {179, 68, 191, 112}, {246, 231, 228, 25}};
  for (const auto& p : published) {
    const Colour colour = colour_of(p.entry, {0, 255});
    EXPECT_NEAR(colour.red, p.red, 7) << p.entry;
    EXPECT_NEAR(colour.green, p.green, 7) << p.entry;
    EXPECT_NEAR(colour.blue, p.blue, 7) << p.entry;
  }
}

TEST(ColourScale, GrowsLighterAllAlong) {
  // Relative luminance, Rec. 709 weights on linearised sRGB; a perceptual scale must order values without its bar.
  const auto luminance = [](Colour c) {
    const auto linear = [](int v) { return std::pow(v / 255.0, 2.2); };
    return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  };
  for (int i = 0; i < 64; ++i) {
    EXPECT_LT(luminance(colour_of(i, {0, 64})), luminance(colour_of(i + 1, {0, 64}))) << i;
  }
}

TEST(ColourRange, IsTheInnerPercentilesRoundedOutwards) {
  std::vector<double> values;
  for (int i = 1; i <= 1000; ++i) values.push_back(-100 + 0.05 * i);  // 1st percentile −99.5, 99th −50.5
  values[0] = -300;                                                   // outliers do not widen the scale
  values[999] = 0;
  const ValueRange range = colour_range(values);
  EXPECT_EQ(range.low, -100);
  EXPECT_EQ(range.high, -50);
  const ValueRange one = colour_range(std::vector<double>{-80});
  EXPECT_EQ(one.low, -80);
  EXPECT_EQ(one.high, -70);
  const ValueRange wide = colour_range(std::vector<double>{-250, -51});
  EXPECT_EQ(wide.low, -170);  // at most 120 dB
  EXPECT_EQ(wide.high, -50);
}

TEST(Text, IsAlwaysValid) {
  EXPECT_EQ(printable("Straße ₂ 😀"), "Straße ₂ 😀");
  EXPECT_EQ(printable("a\nb"), "a\uFFFDb");
  EXPECT_EQ(printable("\xff\xc3"), "\uFFFD\uFFFD");
  EXPECT_EQ(printable("\xc0\x80"), "\uFFFD\uFFFD");            // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // surrogate
  EXPECT_EQ(printable("\xc2\x85"), "\uFFFD");                  // C1 control
  EXPECT_EQ(shorten("short", 1000, 20), "short");
  const std::string cut = shorten("receiver_with_a_long_name_1", 150, 20);
  EXPECT_LE(text_width(cut, 20), 150);
  EXPECT_TRUE(cut.ends_with("_1") && cut.starts_with("rec")) << cut;  // names that differ at the end stay different
}

TEST(LabelPlacer, KeepsLabelsApart) {
  LabelPlacer placer({0, 0, 400, 300});
  std::vector<PlotBox> places;
  for (int i = 0; i < 6; ++i) {
    const auto place = placer.place({200, 150}, 80, 20, 10, 200);
    ASSERT_TRUE(place);
    for (const PlotBox& other : places) EXPECT_FALSE(place->overlaps(other));
    places.push_back(*place);
  }
  EXPECT_FALSE(placer.place({200, 150}, 500, 20, 10, 200)) << "wider than the room";
}

TEST(MapPicture, ShowsEachSortOfCellInItsColour) {
  // Row 0 is the south: inside, not reached, −60 dB; row 1: −80, −100, −90 dB.
  const Plan plan = small_plan(3, 2);
  const MapPicture picture = coverage_picture(Scene{}, plan, with_gains({nan_value, 0, 1e-6, 1e-8, 1e-10, 1e-9}));
  EXPECT_EQ(picture.scale.low, -100);
  EXPECT_EQ(picture.scale.high, -60);
  EXPECT_EQ(cell_colour(picture, 0), inside_colour);
  EXPECT_EQ(cell_colour(picture, 2), colour_of(-60, picture.scale));
  EXPECT_EQ(cell_colour(picture, 3), colour_of(-80, picture.scale));
  EXPECT_EQ(cell_colour(picture, 4), colour_of(-100, picture.scale));
  // Hatched: nothing but its two colours, and both of them.
  const MapFrame& frame = picture.frame;
  const int side = frame.columns / 3;
  EXPECT_EQ(frame.columns, 3 * side);
  EXPECT_EQ(frame.rows, 2 * side) << "cells are squares";
  int plain = 0, hatched = 0;
  for (int j = 4; j < side - 4; ++j) {
    for (int i = 4; i < side - 4; ++i) {
      const Colour c = picture.canvas.pixel(frame.left + side + i, frame.top + side + j);
      plain += c == unreached_colour;
      hatched += c == unreached_hatch_colour;
    }
  }
  EXPECT_EQ(plain + hatched, (side - 8) * (side - 8));
  EXPECT_GT(plain, hatched);
  EXPECT_GT(hatched, 0);
}

TEST(MapPicture, DoesNotHideAFault) {
  const Plan plan = small_plan(2, 1);
  Result result = with_gains({nan_value, 1e-6});
  result.coverage->inside_fraction[0] = 0.5;
  EXPECT_EQ(cell_colour(coverage_picture(Scene{}, plan, result), 0), fault_colour);
}

TEST(MapPicture, CellsEndWhereTheirMetresEnd) {
  const Plan plan = small_plan(4, 3);
  std::vector<double> gains(12, 1e-9);
  gains[5] = 1e-6;  // x −5 … 0, y 25 … 30
  gains[11] = 1e-12;
  const MapPicture picture = coverage_picture(Scene{}, plan, with_gains(gains));
  const Colour bright = colour_of(-60, picture.scale);
  const int left = int(std::lround(picture.frame.x(-5))), right = int(std::lround(picture.frame.x(0)));
  const int top = int(std::lround(picture.frame.y(30))), bottom = int(std::lround(picture.frame.y(25)));
  const Canvas& canvas = picture.canvas;
  EXPECT_EQ(canvas.pixel(left, top), bright);
  EXPECT_EQ(canvas.pixel(right - 1, bottom - 1), bright);
  EXPECT_NE(canvas.pixel(left - 1, top), bright);
  EXPECT_NE(canvas.pixel(left, top - 1), bright);
  EXPECT_NE(canvas.pixel(right, bottom - 1), bright);
  EXPECT_NE(canvas.pixel(right - 1, bottom), bright);
}

TEST(MapPicture, ShowsTheSumOverTransmitters) {
  Plan plan = small_plan(2, 1);
  plan.request.transmitters.push_back(plan.request.transmitters.front());
  Result result = with_gains({1e-6, 1e-9, 1e-6, 1e-9});
  result.coverage->inside_fraction.resize(2);
  const MapPicture picture = coverage_picture(Scene{}, plan, result);
  EXPECT_EQ(cell_colour(picture, 0), colour_of(10 * std::log10(2e-6), picture.scale));
  EXPECT_EQ(cell_colour(picture, 1), colour_of(10 * std::log10(2e-9), picture.scale));
}

TEST(MapPicture, ShowsSoundAsLevel) {
  Plan plan = small_plan(1, 1);
  plan.request.kind = WaveKind::acoustic;
  plan.frequency = {500};
  plan.request.transmitters.front().power = {93};
  const ShownQuantity quantity = shown_quantity(plan);
  const double gain = 1 / (4 * 3.14159265358979 * 100);  // free field at 10 m
  // L_p = L_W − 11 − 20 lg r + 10 lg(ρc/400): 93 − 31 + 0.14 at 20 °C, where ρc is 413 Pa·s/m to 1 (0.01 dB).
  EXPECT_NEAR(quantity.decibels(0, gain), 93 - 30.99 + 0.14, 0.02);
  const MapPicture picture = coverage_picture(Scene{}, plan, with_gains({gain}));
  EXPECT_EQ(picture.scale.low, 60);
  EXPECT_EQ(picture.scale.high, 70);
}

TEST(MapPicture, DrawsWallsWhereTheReceiversPlaneCutsThem) {
  // A screen across the map at x = 0, 0 … 10 m high; the same one 2 m above the receivers leaves no mark.
  const Plan plan = small_plan(4, 4);
  const auto centre_line = [&](double low, double high) {
    Scene scene;
    scene.vertices = {{0, 0, low}, {0, 100, low}, {0, 100, high}, {0, 0, high}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    const MapPicture picture = coverage_picture(scene, plan, with_gains(std::vector<double>(16, 1e-9)));
    return picture.canvas.pixel(int(picture.frame.x(0)), int(picture.frame.y(27.5)));
  };
  EXPECT_LT(centre_line(0, 10).green, 60) << "nearly black";
  EXPECT_EQ(centre_line(3.5, 10), colour_of(-90, {-90, -80}));
}

TEST(MapPicture, DrawsRoofEdgesAboveTheReceivers) {
  const Plan plan = small_plan(4, 4);
  const auto at_edge = [&](double z) {
    Wedge edge{};
    edge.start = {0, 0, z};
    edge.direction = {0, 1, 0};
    edge.length = 100;
    Scene scene;
    scene.wedges.wedges = {edge};
    const MapPicture picture = coverage_picture(scene, plan, with_gains(std::vector<double>(16, 1e-9)));
    return picture.canvas.pixel(int(picture.frame.x(0)), int(picture.frame.y(27.5)));
  };
  EXPECT_NE(at_edge(20), colour_of(-90, {-90, -80}));
  EXPECT_EQ(at_edge(1), colour_of(-90, {-90, -80}));
}

TEST(MapPicture, DrawsGridsOfEveryShape) {
  const std::pair<std::size_t, std::size_t> shapes[] = {{1, 1}, {2000, 100}, {20, 900}, {5000, 3}, {1, 4000}};
  for (const auto& [nx, ny] : shapes) {
    Plan plan = small_plan(nx, ny);
    for (const double gain : {nan_value, 0.0, 1e-9}) {
      const MapPicture picture = coverage_picture(Scene{}, plan, with_gains(std::vector<double>(nx * ny, gain)));
      const MapFrame& frame = picture.frame;
      EXPECT_GE(frame.columns, 1);
      EXPECT_GE(frame.rows, 1);
      EXPECT_LE(std::max(frame.columns, frame.rows), 3000);
      EXPECT_LT(frame.left + frame.columns, picture.canvas.width());
      EXPECT_LT(frame.top + frame.rows, picture.canvas.height());
      // Equal aspect: either side is rounded to a whole pixel, so the sides of a cell may differ by that much.
      EXPECT_LE(std::abs(frame.columns / double(nx) - frame.rows / double(ny)), 0.5 / double(nx) + 0.5 / double(ny));
      EXPECT_EQ(frame.cell_at(0, frame.rows - 1), 0u);
      EXPECT_EQ(frame.cell_at(frame.columns - 1, 0), plan.grid.size() - 1);
    }
  }
}

TEST(DrawCoverage, WritesAPngOfThePicture) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "grimaldi_map_picture_test";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "coverage.png";
  const Plan plan = small_plan(3, 2);
  const Result result = with_gains({nan_value, 0, 1e-6, 1e-8, 1e-10, 1e-9});
  Scene scene;
  scene.name = "broken\xff name.xml";
  draw_coverage(file, scene, plan, result);
  const std::string bytes = bytes_of(file);
  ASSERT_GE(bytes.size(), 33u);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bytes.substr(12, 4), "IHDR");
  const MapPicture picture = coverage_picture(scene, plan, result);
  EXPECT_EQ(big_endian(bytes, 16), unsigned(picture.canvas.width()));
  EXPECT_EQ(big_endian(bytes, 20), unsigned(picture.canvas.height()));
  EXPECT_EQ(bytes, picture.canvas.png()) << "the same input gives the same file";
  std::filesystem::remove_all(folder);
  EXPECT_THROW(draw_coverage(folder / "not" / "there.png", scene, plan, result), InputErrors);
}

/// A receiver with two arrivals, in 20 bins of 10 ns.
ReceiverProfile two_arrivals(const std::string& name, double gain) {
  ReceiverProfile profile;
  profile.name = name;
  for (int i = 0; i < 20; ++i) profile.delay.push_back((i + 10.5) * 10e-9);
  profile.power.assign(20, 0);
  profile.power[2] = gain;
  profile.power[9] = gain / 100;
  profile.total = profile.total_coherent = {1.01 * gain};
  profile.mean_delay = {126e-9};
  profile.rms_delay_spread = {7e-9};
  PathStory direct;
  direct.delay = 125e-9;
  direct.amplitude = {std::sqrt(gain), 0};
  profile.paths = {{direct}};
  return profile;
}

TEST(ProfilePicture, GrowsWithTheReceiversUpToTwelve) {
  const Plan plan = small_plan(1, 1);
  const auto height = [&](std::size_t count) {
    Result result;
    for (std::size_t i = 0; i < count; ++i) result.profiles.push_back(two_arrivals("r" + std::to_string(i), 1e-9));
    return profile_picture(plan, result).height();
  };
  EXPECT_GT(height(2), height(1));
  EXPECT_EQ(height(12), height(11));  // two columns
  EXPECT_GT(height(13), height(12));  // the note
  EXPECT_EQ(height(40), height(13));
  EXPECT_GT(height(0), 0);
}

TEST(ProfilePicture, DrawsBarsOnlyWhereSomethingArrived) {
  const Plan plan = small_plan(1, 1);
  const auto bars = [&](double gain) {
    Result result;
    result.profiles.push_back(two_arrivals("corner", gain));
    if (gain == 0) {
      result.profiles[0].paths[0].clear();
      result.profiles[0].mean_delay = result.profiles[0].rms_delay_spread = {nan_value};
    }
    const Canvas canvas = profile_picture(plan, result);
    int count = 0;
    const Colour bar = mix({0, 114, 178}, white, 0.6);  // the first transmitter's colour, lightened
    for (int y = 0; y < canvas.height(); ++y) {
      for (int x = 0; x < canvas.width(); ++x) count += canvas.pixel(x, y) == bar;
    }
    return count;
  };
  EXPECT_GT(bars(1e-9), 1000);
  EXPECT_EQ(bars(0), 0);
}

}  // namespace
}  // namespace grimaldi
