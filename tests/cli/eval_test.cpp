// `grimaldi eval` as it is shipped: every row of every reference file within its tolerance, and bad tables refused with
// a message that helps.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "cli/csv_rows.h"
#include "core/constants.h"
#include "tests/cli/program.h"
#include "validation/aperture_shape.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;
using test::Outcome;

class Eval : public test::Program {
 protected:
  Outcome eval(const std::vector<std::string>& words) const {
    std::vector<std::string> all = {"eval"};
    all.insert(all.end(), words.begin(), words.end());
    return run(all);
  }

  // Refused with exit 1 and one line that has all `parts`; nothing on stdout, no file left.
  void refused(const std::vector<std::string>& words, const std::vector<std::string>& parts) const {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--out", "out.csv"});
    const Outcome outcome = eval(all);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    std::istringstream lines(outcome.err);
    bool found = false;
    for (std::string line; std::getline(lines, line);)
      found |= line.rfind("error: ", 0) == 0 && std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
                 return line.find(part) != std::string::npos;
               });
    EXPECT_TRUE(found) << outcome.err;
    for (const std::string& name : files_in("."))
      EXPECT_TRUE(name.find("out.csv") == std::string::npos) << "left over: " << name;
  }
};

// ---- the reference files --------------------------------------------------------------------------------------------

// A row of the output with the columns of its input and of the function.
struct Row {
  const CsvRows& table;
  std::size_t index;
  double operator[](const std::string& name) const {
    const auto column = table.column(name);
    if (!column) throw std::runtime_error("no column " + name);
    return std::stod(table.rows[index][*column]);
  }
  const std::string& text(const std::string& name) const { return table.rows[index][*table.column(name)]; }
};

struct ReferenceCase {
  std::string file, function;
  std::vector<std::pair<std::string, std::string>> compared;  ///< column of the file (as it stands in the output), ours
  std::function<double(const Row&)> tolerance;                ///< absolute
  std::size_t least;                                          ///< rows
};

// Pairs in_NAME, NAME.
std::vector<std::pair<std::string, std::string>> same(const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& name : names) pairs.emplace_back("in_" + name, name);
  return pairs;
}

const std::vector<std::string> soft_hard = {"soft_re", "soft_im", "hard_re", "hard_im"};

std::function<double(const Row&)> fixed(double tolerance) {
  return [tolerance](const Row&) { return tolerance; };
}

// Half a unit of the last digit printed in that column.
double half_a_unit(const std::string& text) {
  const auto point = text.find('.');
  return point == std::string::npos ? 0.5 : 0.5 * std::pow(10.0, -double(text.size() - point - 1));
}

// Twice the areas of the triangles of a row of fsd_vectors.csv, and its largest amplitude.
double fsd_scale(const Row& row) {
  const auto numbers = [](const std::string& text) {
    std::istringstream words(text);
    std::vector<double> list;
    for (double x = 0; words >> x;) list.push_back(x);
    return list;
  };
  const auto u = numbers(row.text("verts_xy")), a = numbers(row.text("amps_re_im")), t = numbers(row.text("tris"));
  double area = 0, high = 0;
  for (std::size_t i = 0; i + 1 < a.size(); i += 2) high = std::max(high, std::hypot(a[i], a[i + 1]));
  for (std::size_t i = 0; i + 2 < t.size(); i += 3) {
    const auto x = [&](std::size_t j) { return u[2 * std::size_t(t[i + j])]; };
    const auto y = [&](std::size_t j) { return u[2 * std::size_t(t[i + j]) + 1]; };
    area += 0.5 * std::abs((x(1) - x(0)) * (y(2) - y(0)) - (y(1) - y(0)) * (x(2) - x(0)));
  }
  return row["k"] * area * high / (2 * pi);
}

double larger(const Row& row, const std::string& a, const std::string& b) {
  return std::max(std::hypot(row[a + "_re"], row[a + "_im"]), std::hypot(row[b + "_re"], row[b + "_im"]));
}

// The tolerances of reference/README.md, file by file.
const std::vector<ReferenceCase>& reference_cases() {
  static const std::vector<ReferenceCase> cases = {
      {"radio/utd_transition_F.csv", "transition", same({"F_re", "F_im"}),
       [](const Row& r) { return 1e-14 * std::hypot(r["in_F_re"], r["in_F_im"]); }, 60},
      {"radio/utd_kp_coefficients.csv", "utd", same({"Ds_re", "Ds_im", "Dh_re", "Dh_im"}),
       [](const Row& r) { return 1e-10 * larger(r, "in_Ds", "in_Dh"); }, 90},
      {"radio/utd_vs_exact.csv",
       "utd-total",
       {{"utd_soft_re", "soft_re"}, {"utd_soft_im", "soft_im"}, {"utd_hard_re", "hard_re"}, {"utd_hard_im", "hard_im"}},
       fixed(1e-10),
       60},
      {"fsd_vectors.csv", "fsd-field", same({"psi_re", "psi_im"}), [](const Row& r) { return 1e-12 * fsd_scale(r); },
       150},
      {"radio/fresnel_knife_edge.csv", "knife-edge", same({"E_re", "E_im"}), fixed(1e-13), 40},
      {"radio/fresnel_knife_edge.csv", "knife-edge", {{"J_exact_dB", "J_dB"}}, fixed(1e-9), 40},
      {"radio/utd_vs_exact.csv",
       "wedge-exact",
       {{"exact_soft_re", "soft_re"},
        {"exact_soft_im", "soft_im"},
        {"exact_hard_re", "hard_re"},
        {"exact_hard_im", "hard_im"}},
       fixed(1e-10),
       60},
      {"radio/halfplane_sommerfeld.csv", "half-plane-exact", same(soft_hard),
       [](const Row& r) { return r["k_rho"] > 9000 ? 1e-10 : 1e-12; }, 150},
      {"radio/wedge_exact_planewave.csv", "wedge-exact", same(soft_hard),
       [](const Row& r) { return r["k_rho"] <= 40    ? 1e-12
                                 : r["k_rho"] <= 150 ? 1e-11
                                                     : 1e-10; }, 800},
      {"radio/wedge_exact_linesource.csv", "wedge-exact-line", same(soft_hard), fixed(1e-12), 150},
      {"radio/wedge_exact_pointsource.csv", "wedge-exact-point", same(soft_hard),
       [](const Row& r) { return 1e-11 / std::hypot(r["rho"] + r["rho_s"], r["z"] - r["z_s"]); }, 300},
      {"radio/aperture_fraunhofer.csv", "fraunhofer", same({"I_re", "I_im"}),
       [](const Row& r) { return 1e-12 * area(aperture_shape(r.text("shape"), r.text("params"))); }, 90},
      {"radio/aperture_rayleigh_sommerfeld.csv", "rayleigh-sommerfeld", same({"u_re", "u_im"}), fixed(1e-11), 50},
      {"radio/knife_edge_double.csv", "double-knife-edge", same({"E_re", "E_im", "loss_exact_dB"}), fixed(1e-9), 10},
      {"radio/fresnel_coefficients.csv", "fresnel", same({"RTE_re", "RTE_im", "RTM_re", "RTM_im"}),
       [](const Row& r) { return r.text("material") == "metal" ? 1e-9 : 1e-12; }, 70},
      {"radio/slab_coefficients.csv", "slab",
       same({"RTE_re", "RTE_im", "RTM_re", "RTM_im", "TTE_re", "TTE_im", "TTM_re", "TTM_im"}), fixed(1e-12), 70},
      {"radio/p676_13_specific_attenuation.csv", "gas", same({"gamma_dBkm"}),
       [](const Row& r) { return 1e-6 * r["in_gamma_dBkm"]; }, 70},
      {"radio/p676_12_specific_attenuation.csv", "gas", same({"gamma_dBkm"}),
       [](const Row& r) { return 1e-6 * r["in_gamma_dBkm"]; }, 40},
      {"radio/p676_13_other_atmospheres.csv", "gas", same({"gamma_dBkm"}),
       [](const Row& r) { return 1e-6 * r["in_gamma_dBkm"]; }, 40},
      {"radio/p838_3_rain.csv", "rain", same({"gamma_dBkm"}), [](const Row& r) { return 1e-6 * r["in_gamma_dBkm"]; },
       30},
      {"acoustic/iso9613_air_absorption.csv", "air-absorption", same({"alpha_dB_per_km"}),
       [](const Row& r) {
         return std::max(0.005 * r["in_alpha_dB_per_km"], half_a_unit(r.text("in_alpha_dB_per_km")) * (1 + 1e-9));
       },
       60},
  };
  return cases;
}

TEST_F(Eval, EveryRowOfEveryReferenceFile) {
  if (!fs::exists(std::string(GRIMALDI_SHARED) + "/reference/README.md")) GTEST_SKIP() << "needs ../shared/reference";
  for (const ReferenceCase& c : reference_cases()) {
    SCOPED_TRACE(c.file);
    const std::string file = std::string(GRIMALDI_SHARED) + "/reference/" + c.file;
    const Outcome outcome = eval({c.function, "--in", file, "--out", "out.csv"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    Diagnostics diagnostics;
    const CsvRows table = read_csv(contents("out.csv"), "out.csv", diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    EXPECT_GE(table.rows.size(), c.least);
    double worst = 0, worst_share = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const Row row{table, i};
      const double tolerance = c.tolerance(row);
      for (const auto& [theirs, ours] : c.compared) {
        const double error = std::abs(row[theirs] - row[ours]);
        EXPECT_LE(error, tolerance) << table.rows[i][0] << " " << ours;
        worst = std::max(worst, error);
        if (tolerance > 0) worst_share = std::max(worst_share, error / tolerance);
      }
    }
    std::printf("%-44s %-20s %4zu rows, largest error %.1e, %.1e of its tolerance\n", c.file.c_str(),
                c.function.c_str(), table.rows.size(), worst, worst_share);
  }
}

// ---- the form of tables ---------------------------------------------------------------------------------------------

TEST_F(Eval, ColumnsAreCarriedThroughAndRenamed) {
  write("rows.csv",
        "# a comment\r\nnote,F_re,x\r\n\"one, \"\"two\"\"\",7, 1\r\n\r\n# another\nsecond,8,+2.5e-1\n\"#third\",,0\n");
  const Outcome outcome = eval({"transition", "--in", "rows.csv"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  Diagnostics diagnostics;
  const CsvRows table = read_csv(outcome.out, "stdout", diagnostics);
  EXPECT_EQ(table.names, (std::vector<std::string>{"note", "in_F_re", "x", "F_re", "F_im"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0][0], "one, \"two\"");
  EXPECT_EQ(table.rows[0][1], "7");
  EXPECT_EQ(table.rows[1][2], "+2.5e-1");
  EXPECT_EQ(table.rows[2][0], "#third");
  EXPECT_EQ(table.rows[2][3], "0");
  // 17 digits: the double itself. F(1) from mpmath.
  EXPECT_NEAR(std::stod(table.rows[0][3]), 0.80952548174740884, 1e-15);
}

TEST_F(Eval, ResultsCanBeFedInAgain) {
  write("rows.csv", "x\n1\n2\n");
  EXPECT_EQ(eval({"transition", "--in", "rows.csv", "--out", "a.csv"}).code, 0);
  EXPECT_EQ(eval({"transition", "--in", "a.csv", "--out", "a.csv"}).code, 0);  // onto itself
  EXPECT_EQ(eval({"transition", "--in", "a.csv", "--out", "c.csv"}).code, 0);
  Diagnostics diagnostics;
  const CsvRows table = read_csv(contents("c.csv"), "c.csv", diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(table.names,
            (std::vector<std::string>{"x", "in_in_F_re", "in_in_F_im", "in_F_re", "in_F_im", "F_re", "F_im"}));
  EXPECT_EQ(table.rows[1][1], table.rows[1][5]);
  EXPECT_EQ(files_in("."), (std::vector<std::string>{"a.csv", "c.csv", "rows.csv", "stderr.txt", "stdout.txt"}));
}

// A link stays a link and its file is replaced; a device is written in place.
TEST_F(Eval, LinksStayLinks) {
  write("rows.csv", "x\n1\n");
  write("real.csv", "old\n");
  fs::create_symlink("real.csv", folder_ / "link.csv");
  EXPECT_EQ(eval({"transition", "--in", "rows.csv", "--out", "link.csv"}).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.csv"));
  EXPECT_FALSE(fs::is_symlink(folder_ / "real.csv"));
  EXPECT_GT(fs::file_size(folder_ / "real.csv"), 20u);
  EXPECT_EQ(eval({"transition", "--in", "rows.csv", "--out", "/dev/null"}).code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_symlink("nowhere/at-all.csv", folder_ / "dangling.csv");
  EXPECT_EQ(eval({"transition", "--in", "rows.csv", "--out", "dangling.csv"}).code, 1);
  EXPECT_TRUE(fs::is_symlink(folder_ / "dangling.csv"));
}

TEST_F(Eval, RatiosBoundariesAndNames) {
  // 5/3 is met exactly; on the boundary itself the field is that of either side, for a hard wedge half the incident
  // wave and the rest; names in any case, blanks as underscores.
  write("wedge.csv", "n,k_rho,phi_deg,phip_deg\n5/3,10,210,30\n1.6666666666666667,10,210,30\n5/3,10,300,30\n");
  const Outcome wedge = eval({"utd-total", "--in", "wedge.csv"});
  EXPECT_EQ(wedge.code, 0) << wedge.err;
  write("slab.csv", "material,params,f_GHz,theta_deg\nITU Ceiling Board,p.2040-3,2,30\nceiling_board,P.2040-3,2,30\n");
  const Outcome slab = eval({"fresnel", "--in", "slab.csv"});
  EXPECT_EQ(slab.code, 0) << slab.err;
  Diagnostics diagnostics;
  const CsvRows table = read_csv(slab.out, "stdout", diagnostics);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(std::vector<std::string>(table.rows[0].begin() + 4, table.rows[0].end()),
            std::vector<std::string>(table.rows[1].begin() + 4, table.rows[1].end()));
  const CsvRows angles = read_csv(wedge.out, "stdout", diagnostics);
  ASSERT_EQ(angles.rows.size(), 3u);
  for (std::size_t i = 4; i < 8; ++i) EXPECT_NEAR(std::stod(angles.rows[0][i]), std::stod(angles.rows[1][i]), 1e-13);
}

TEST_F(Eval, ListAndHelp) {
  const Outcome list = eval({"--list"});
  EXPECT_EQ(list.code, 0);
  std::vector<std::string> names;
  std::istringstream lines(list.out);
  for (std::string line; std::getline(lines, line);) names.push_back(line.substr(0, line.find(' ')));
  for (const ReferenceCase& c : reference_cases())
    EXPECT_NE(std::find(names.begin(), names.end(), c.function), names.end()) << c.function;
  for (const std::string& name : names) {
    const Outcome help = eval({name, "--help"});
    EXPECT_EQ(help.code, 0) << name;
    for (const char* part : {"Reads", "Adds", "--in ROWS.csv", "carried through"})
      EXPECT_NE(help.out.find(part), std::string::npos) << name;
  }
  EXPECT_NE(eval({"--help"}).out.find("--list"), std::string::npos);
  EXPECT_EQ(eval({"utd", "-h"}).out, eval({"utd", "--help"}).out);
}

TEST_F(Eval, WarnsOnceForEachColumn) {
  write("rows.csv", "material,params,f_GHz,theta_deg\nconcrete,P.2040-3,0.5,30\nconcrete,P.2040-3,0.6,30\n");
  const Outcome outcome = eval({"fresnel", "--in", "rows.csv", "--out", "out.csv"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("warning: rows.csv:2: material.concrete"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(eval({"fresnel", "--in", "rows.csv", "--out", "out.csv", "--quiet"}).err, "");
}

// ---- bad tables -----------------------------------------------------------------------------------------------------

TEST_F(Eval, BadNumbers) {
  const auto with = [&](const std::string& row) { write("rows.csv", "n,k_rho,phi_deg,phip_deg\n3/2,1,20,30\n" + row); };
  const std::vector<std::string> words = {"utd-total", "--in", "rows.csv"};
  with("3/2,ten,20,30\n");
  refused(words, {"rows.csv:3: k_rho", "\"ten\" is not a finite number", "distance from the edge", "write a number"});
  with("3/2,10m,20,30\n");
  refused(words, {"rows.csv:3: k_rho", "\"10m\"", "units stand in the name of the column"});
  for (const char* text : {"nan", "NaN", "inf", "-inf", "1e999", "0x10", "1,5", "1e", "--1"}) {
    with("3/2," + std::string(text) + ",20,30\n");
    refused(words, {"rows.csv:3"});
  }
  with("3/2,,20,30\n");
  refused(words, {"rows.csv:3: k_rho", "an empty field"});
  with("3/2,0,20,30\n");
  refused(words, {"rows.csv:3: k_rho", "0 is out of range", "above 0"});
  for (const char* n : {"5/2", "0", "-1/2", "3/0", "3/", "/2", "3/2/1", "a/b"}) {
    with(std::string(n) + ",1,20,30\n");
    refused(words, {"rows.csv:3: n", n});
  }
  with("3/2,1,271,30\n");
  refused(words, {"rows.csv:3: phi_deg", "271 degrees lie inside the wedge", "270 degrees"});
  // All faults at once, then a count.
  std::string many = "n,k_rho,phi_deg,phip_deg\nx,y,20,30\n";
  for (int i = 0; i < 30; ++i) many += "3/2,y,20,30\n";
  write("rows.csv", many);
  refused(words, {"rows.csv:2: n"});
  refused(words, {"rows.csv:2: k_rho"});
  refused(words, {"rows.csv:11: k_rho"});
  refused(words, {"21 more rows"});
}

TEST_F(Eval, BadTables) {
  const std::vector<std::string> words = {"transition", "--in", "rows.csv"};
  write("rows.csv", "X,y\n1,2\n");
  refused(words, {"rows.csv:1: x", "no such column", "argument", "did you mean X?"});
  write("rows.csv", "x,y\n1,2,3\n");
  refused(words, {"rows.csv:2", "3 fields, 2 are needed"});
  write("rows.csv", "x,y\n1\n");
  refused(words, {"rows.csv:2", "1 fields, 2 are needed"});
  write("rows.csv", "x,x\n1,2\n");
  refused(words, {"rows.csv:1: x", "two columns of one name"});
  write("rows.csv", "x,\n1,2\n");
  refused(words, {"rows.csv:1: column 2", "has no name"});
  write("rows.csv", "# only\n\n");
  refused(words, {"rows.csv", "no line of names"});
  write("rows.csv", "x,y\n1,\"2\n3,4\n");
  refused(words, {"rows.csv:2", "a quote is not closed"});
  write("rows.csv", "");
  refused(words, {"rows.csv", "empty"});
  write("rows.csv", std::string("x\n\0\xff\n", 5));
  refused(words, {"rows.csv:2: x", "not a finite number"});
  refused({"transition", "--in", "row.csv"}, {"row.csv", "no such file", "did you mean rows.csv?"});
  refused({"transition", "--in", "."}, {"is a folder"});
  // A table without rows is a table.
  write("rows.csv", "x\n");
  const Outcome none = eval({"transition", "--in", "rows.csv"});
  EXPECT_EQ(none.code, 0);
  EXPECT_EQ(none.out, "x,F_re,F_im\n");
}

TEST_F(Eval, BadWords) {
  refused({"transiton"}, {"eval transiton", "unknown function", "did you mean transition?"});
  refused({}, {"no function given", "--list"});
  refused({"transition", "--inn", "a"}, {"--inn", "unknown option", "did you mean --in?"});
  refused({"transition", "utd"}, {"utd", "one argument too many"});
  refused({"transition", "--in", ""}, {"--in", "an empty name"});
  write("rows.csv", "x\n1\n");
  fs::create_directories(folder_ / "folder");
  for (const auto& [name, why] :
       {std::pair{"folder", "it is a folder"}, {"nowhere/out.csv", "its folder is not there"}}) {
    const Outcome outcome = eval({"transition", "--in", "rows.csv", "--out", name});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  }
  EXPECT_TRUE(files_in("folder").empty());
  // A table at fault leaves what was there.
  write("out.csv", "mine");
  write("rows.csv", "x\n-1\n");
  EXPECT_EQ(eval({"transition", "--in", "rows.csv", "--out", "out.csv"}).code, 1);
  EXPECT_EQ(contents("out.csv"), "mine");
}

TEST_F(Eval, BadMaterialsPolygonsAndBands) {
  const auto row = [&](const std::string& names, const std::string& fields) {
    write("rows.csv", names + "\n" + fields + "\n");
  };
  const std::string slab = "material,params,f_GHz,d_m,theta_deg";
  row(slab, "concret,P.2040-3,1,0.1,30");
  refused({"slab", "--in", "rows.csv"},
          {"rows.csv:2: material", "unknown material \"concret\"", "did you mean concrete?"});
  row(slab, "clear_acrylic,P.2040-3,1,0.1,30");
  refused({"slab", "--in", "rows.csv"}, {"rows.csv:2: material", "not in the table of P.2040-3"});
  row(slab, "concrete,P.2040-9,1,0.1,30");
  refused({"slab", "--in", "rows.csv"}, {"rows.csv:2: params", "\"P.2040-9\" is no version", "P.2040-4"});
  row(slab, "concrete,P.2040-3,1,-0.1,30");
  refused({"slab", "--in", "rows.csv"}, {"rows.csv:2: d_m", "out of range"});
  row(slab, "concrete,P.2040-3,1,0.1,91");
  refused({"slab", "--in", "rows.csv"}, {"rows.csv:2: theta_deg", "out of range", "0 ... 90"});
  const std::string polygon = "k,xi_x,xi_y,verts_xy,amps_re_im,tris";
  row(polygon, "1,0,0,0 0 1 0 0 1,1 0 1 0 1 0,0 1 3");
  refused({"fsd-field", "--in", "rows.csv"}, {"rows.csv:2: tris", "3 is no vertex", "from 0 to 2"});
  row(polygon, "1,0,0,0 0 1 0 0 1,1 0 1 0 1,0 1 2");
  refused({"fsd-field", "--in", "rows.csv"}, {"rows.csv:2: amps_re_im", "5 numbers for 3 vertices"});
  row(polygon, "1,0,0,0 0 1 zero 0 1,1 0 1 0 1 0,0 1 2");
  refused({"fsd-field", "--in", "rows.csv"}, {"rows.csv:2: verts_xy", "\"zero\" is not a finite number"});
  row("shape,params,kx,ky", "rect,wx=1;wy=-1,0,0");
  refused({"fraunhofer", "--in", "rows.csv"}, {"rows.csv:2", "params"});
  row("shape,params,kx,ky", "rectangel,wx=1;wy=1,0,0");
  refused({"fraunhofer", "--in", "rows.csv"}, {"rows.csv:2", "shape"});
  row("temperature_C,rel_humidity_pct,nominal_frequency_Hz", "20,50,900");
  refused({"air-absorption", "--in", "rows.csv"},
          {"nominal_frequency_Hz", "900 Hz is no nominal frequency", "write 1000"});
}

}  // namespace
}  // namespace grimaldi
