#include "propagation/result_file.h"

#include <hdf5.h>
#include <hdf5_hl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace grimaldi {
namespace {

constexpr int format_version = 1;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
/// Variables above this size are cut into chunks and deflated; below it the bookkeeping outweighs the gain.
constexpr std::size_t plain_bytes = 64 * 1024;
/// Values in a chunk: 512 KiB of doubles, so that a chunk fits HDF5's cache of 1 MiB.
constexpr hsize_t chunk_values = 65536;

/// A file under a hidden temporary name in the folder of its final name; removed again unless committed.
class PartialFile {
 public:
  explicit PartialFile(std::filesystem::path final_name)
      : final_name_(std::move(final_name)),
        name_(final_name_.parent_path() /
              ("." + final_name_.filename().string() + ".partial-" + std::to_string(getpid()))) {}
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(name_, ignored);
  }
  const std::filesystem::path& name() const { return name_; }
  void commit() {
    std::error_code error;
    std::filesystem::rename(name_, final_name_, error);
    if (error) fail(error.message());
    committed_ = true;
  }
  [[noreturn]] void fail(const std::string& why) const {
    input_error(final_name_.string(), 0, {}, "the file cannot be written", why,
                "make room on the disk, or name a folder that you may write to with -o");
  }

 private:
  std::filesystem::path final_name_, name_;
  bool committed_ = false;
};

/// An HDF5 call did not succeed; what() = the reason, as the operating system gives it where it does.
struct HdfFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The innermost message of HDF5's error stack; the system's own words if they are in it.
std::string hdf_reason() {
  std::string text;
  const H5E_walk2_t take_first = [](unsigned depth, const H5E_error2_t* error, void* out) -> herr_t {
    if (depth == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &text);
  const std::string mark = "error message = '";
  const std::size_t begin = text.find(mark);
  if (begin != std::string::npos) {
    const std::size_t from = begin + mark.size();
    text = text.substr(from, text.find('\'', from) - from);
  }
  return text.empty() ? "HDF5 gives no reason" : text;
}

template <class Status>
Status checked(Status status) {
  if (status < 0) throw HdfFailure(hdf_reason());
  return status;
}

/// Keeps HDF5 from printing its error stack; what it says goes into one message of ours.
class QuietHdf {
 public:
  QuietHdf() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietHdf(const QuietHdf&) = delete;
  QuietHdf& operator=(const QuietHdf&) = delete;
  ~QuietHdf() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// An open HDF5 object.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close_it) : id_(checked(id)), close_(close_it) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  /// Closes and says whether that worked: chunks are written when their variable is closed.
  void close() { checked(close_(std::exchange(id_, -1))); }

 private:
  hid_t id_;
  Close close_;
};

/// `size` = H5T_VARIABLE or a count of bytes.
Handle utf8_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type, size));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

/// What an object is created with: its attributes in the order of writing, and no time stamps.
void keep_order_without_times(hid_t creation) {
  checked(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  checked(H5Pset_obj_track_times(creation, false));
}

/// Class H5P_GROUP_CREATE or H5P_FILE_CREATE (whose list makes the root group). netCDF-4 wants the order of the members
/// kept.
Handle group_creation(hid_t property_class) {
  Handle creation(H5Pcreate(property_class), H5Pclose);
  keep_order_without_times(creation);
  checked(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  return creation;
}

void write_attribute(hid_t object, const char* name, hid_t type, hid_t space, const void* value) {
  Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, type, value));
  attribute.close();
}

/// A short text, as netCDF's char attributes are. (HDF5 has no text of no bytes: an empty one becomes a lone NUL.)
void set_text(hid_t object, const char* name, const std::string& text) {
  write_attribute(object, name, utf8_type(text.size() + (text.empty() ? 1 : 0)),
                  Handle(H5Screate(H5S_SCALAR), H5Sclose), text.c_str());
}

/// A text of any length (other attributes end at 64 KiB).
void set_long_text(hid_t object, const char* name, const std::string& text) {
  const char* pointer = text.c_str();
  write_attribute(object, name, utf8_type(H5T_VARIABLE), Handle(H5Screate(H5S_SCALAR), H5Sclose), &pointer);
}

/// Numbers; one is an array of one, as netCDF has it.
void set_numbers(hid_t object, const char* name, hid_t type, hsize_t count, const void* values) {
  write_attribute(object, name, type, Handle(H5Screate_simple(1, &count, nullptr), H5Sclose), values);
}
void set_number(hid_t object, const char* name, double value) {
  set_numbers(object, name, H5T_NATIVE_DOUBLE, 1, &value);
}
void set_count(hid_t object, const char* name, std::uint64_t value) {
  set_numbers(object, name, H5T_NATIVE_UINT64, 1, &value);
}

/// What stands beside a variable.
struct Meaning {
  std::string units;  ///< UDUNITS; empty for texts
  std::string long_name;
  bool may_miss = false;  ///< NaN stands for "nothing here": _FillValue
};

/// A group with netCDF dimensions of its own.
class Group {
 public:
  Group(hid_t parent, const std::string& name)
      : id_(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, group_creation(H5P_GROUP_CREATE), H5P_DEFAULT), H5Gclose) {}
  explicit Group(Handle opened) : id_(std::move(opened)) {}
  operator hid_t() const { return id_; }

  /// A dimension with a coordinate variable of the same name.
  void coordinate(const std::string& name, std::span<const double> values, const Meaning& meaning,
                  const char* standard_name = nullptr, const char* axis = nullptr) {
    Handle scale = create(name, H5T_NATIVE_DOUBLE, {values.size()}, false);
    if (!values.empty()) write_data(scale, H5T_NATIVE_DOUBLE, values.data());
    describe(scale, meaning);
    if (standard_name) set_text(scale, "standard_name", standard_name);
    if (axis) set_text(scale, "axis", axis);
    keep_scale(name, std::move(scale), values.size(), name);
  }
  void coordinate(const std::string& name, const std::vector<std::string>& values, const Meaning& meaning) {
    Handle scale = create(name, utf8_type(H5T_VARIABLE), {values.size()}, false);
    write_texts(scale, values);
    describe(scale, meaning);
    keep_scale(name, std::move(scale), values.size(), name);
  }
  /// A dimension without a variable: a scale without data whose name is the sentence that netCDF knows it by.
  void dimension(const std::string& name, hsize_t size) {
    char sentence[80];
    std::snprintf(sentence, sizeof sentence, "This is a netCDF dimension but not a netCDF variable.%10llu",
                  static_cast<unsigned long long>(size));
    keep_scale(name, create(name, H5T_IEEE_F32BE, {size}, false), size, sentence);
  }

  using Dimensions = std::vector<std::string>;
  /// The values go from the caller's memory to the file without a copy.
  void variable(const std::string& name, const Dimensions& dimensions, std::span<const double> values,
                const Meaning& meaning, const std::map<std::string, std::string>& more = {}) {
    put(name, dimensions, values.size(), H5T_NATIVE_DOUBLE, meaning, more, [&](hid_t dataset) {
      if (!values.empty()) write_data(dataset, H5T_NATIVE_DOUBLE, values.data());
    });
  }
  void variable(const std::string& name, const Dimensions& dimensions, std::span<const std::int32_t> values,
                const Meaning& meaning, const std::map<std::string, std::string>& more = {}) {
    put(name, dimensions, values.size(), H5T_NATIVE_INT32, meaning, more, [&](hid_t dataset) {
      if (!values.empty()) write_data(dataset, H5T_NATIVE_INT32, values.data());
    });
  }
  void variable(const std::string& name, const Dimensions& dimensions, const std::vector<std::string>& values,
                const Meaning& meaning) {
    put(name, dimensions, values.size(), utf8_type(H5T_VARIABLE), meaning, {},
        [&](hid_t dataset) { write_texts(dataset, values); });
  }

  void close() {
    for (auto& [name, scale] : scales_) scale.dataset.close();
    scales_.clear();
    id_.close();
  }

 private:
  struct Scale {
    Handle dataset;
    hsize_t size;
  };

  Handle create(const std::string& name, hid_t type, const std::vector<hsize_t>& shape, bool may_miss) const {
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    keep_order_without_times(creation);
    if (may_miss) checked(H5Pset_fill_value(creation, type, &not_a_number));
    std::size_t bytes = H5Tget_size(type);
    for (const hsize_t side : shape) bytes *= side;
    if (bytes > plain_bytes && H5Tis_variable_str(type) == 0) {
      std::vector<hsize_t> chunk(shape.size());
      hsize_t left = chunk_values;
      for (std::size_t i = shape.size(); i-- > 0;) {
        chunk[i] = std::clamp<hsize_t>(left, 1, shape[i]);
        left /= chunk[i];
      }
      checked(H5Pset_chunk(creation, int(chunk.size()), chunk.data()));
      checked(H5Pset_shuffle(creation));
      checked(H5Pset_deflate(creation, 1));
    }
    const Handle space(H5Screate_simple(int(shape.size()), shape.data(), nullptr), H5Sclose);
    return {H5Dcreate2(id_, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose};
  }

  static void write_data(hid_t dataset, hid_t type, const void* data) {
    checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
  }

  static void write_texts(hid_t dataset, const std::vector<std::string>& texts) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    if (!pointers.empty()) write_data(dataset, utf8_type(H5T_VARIABLE), pointers.data());
  }

  static void describe(hid_t dataset, const Meaning& meaning) {
    if (!meaning.units.empty()) set_text(dataset, "units", meaning.units);
    set_text(dataset, "long_name", meaning.long_name);
    if (meaning.may_miss) set_number(dataset, "_FillValue", not_a_number);
  }

  void keep_scale(const std::string& name, Handle scale, hsize_t size, const std::string& scale_name) {
    checked(H5DSset_scale(scale, scale_name.c_str()));
    scales_.emplace(name, Scale{std::move(scale), size});
  }

  /// Throws std::logic_error if `count` is not what the dimensions ask for: a fault of the program, not of its input.
  template <class Write>
  void put(const std::string& name, const Dimensions& dimensions, std::size_t count, hid_t type, const Meaning& meaning,
           const std::map<std::string, std::string>& more, const Write& write) const {
    std::vector<hsize_t> shape;
    std::size_t wanted = 1;
    for (const std::string& dimension : dimensions) wanted *= shape.emplace_back(scales_.at(dimension).size);
    if (count != wanted)
      throw std::logic_error("result: " + name + " has " + std::to_string(count) + " values, its dimensions ask for " +
                             std::to_string(wanted));
    Handle dataset = create(name, type, shape, meaning.may_miss);
    write(dataset);
    describe(dataset, meaning);
    for (const auto& [key, text] : more) set_text(dataset, key.c_str(), text);
    for (unsigned i = 0; i < dimensions.size(); ++i)
      checked(H5DSattach_scale(dataset, scales_.at(dimensions[i]).dataset, i));
    dataset.close();
  }

  Handle id_;
  std::map<std::string, Scale> scales_;
};

std::string polarisation_name(Polarisation polarisation) {
  return polarisation == Polarisation::vertical ? "V" : polarisation == Polarisation::horizontal ? "H" : "both";
}

void write_common_coordinates(Group& group, const Plan& plan) {
  std::vector<std::string> names;
  for (const Transmitter& transmitter : plan.request.transmitters) names.push_back(transmitter.name);
  group.coordinate("transmitter", names, {"", "name of the transmitter"});
  group.coordinate("frequency", plan.frequency, {"Hz", "frequency"},
                   plan.request.kind == WaveKind::radio ? "radiation_frequency" : nullptr);
}

void write_root(hid_t root, const Scene& scene, const Plan& plan, const Result& result, const std::string& version) {
  set_text(root, "Conventions", "CF-1.11");
  set_text(root, "format", "grimaldi-result");
  set_count(root, "format_version", format_version);
  set_text(root, "program", "grimaldi");
  set_text(root, "program_version", version);
  set_text(root, "wave", plan.request.kind == WaveKind::radio ? "radio" : "acoustic");
  set_long_text(root, "scenario", plan.request.text);
  // The plan of passes: how many were run of how many, and how many beams of each transmitter they share.
  set_count(root, "seed", plan.request.seed);
  set_count(root, "passes", std::uint64_t(result.figures.passes));
  set_count(root, "passes_planned", std::uint64_t(plan.request.passes));
  set_number(root, "rays_per_transmitter", plan.request.rays);
  set_count(root, "rays", result.figures.rays);
  char fingerprint[17];
  std::snprintf(fingerprint, sizeof fingerprint, "%016llx", static_cast<unsigned long long>(scene.fingerprint));
  set_text(root, "scene", scene.name);
  set_text(root, "scene_fingerprint", fingerprint);
  if (const auto& origin = plan.request.origin) {
    set_number(root, "origin_latitude", origin->latitude);
    set_number(root, "origin_longitude", origin->longitude);
    set_number(root, "origin_height", origin->height);
    set_number(root, "origin_bearing", origin->bearing);
  }
  set_number(root, "wall_seconds", result.figures.wall_seconds);
  set_number(root, "cpu_seconds", result.figures.cpu_seconds);
}

void write_coverage(hid_t root, const Plan& plan, const CoverageMap& map) {
  const bool radio = plan.request.kind == WaveKind::radio;
  const std::string gain = radio ? "1" : "m-2";
  const GridLayout& grid = plan.grid;
  std::vector<double> x(grid.nx), y(grid.ny);
  for (std::size_t i = 0; i < grid.nx; ++i) x[i] = grid.centre(i).x;
  for (std::size_t i = 0; i < grid.ny; ++i) y[i] = grid.centre(i * grid.nx).y;

  Group group(root, "coverage");
  set_number(group, "cell_size", grid.cell);
  set_number(group, "z", grid.z);
  if (radio && plan.request.coverage)
    set_text(group, "polarisation", polarisation_name(plan.request.coverage->polarisation));
  write_common_coordinates(group, plan);
  group.coordinate("mechanism", std::vector<std::string>(mechanism_names, mechanism_names + mechanism_count),
                   {"", "mechanism of propagation"});
  group.coordinate("y", y, {"m", "centre of the cell, local y (north)"}, "projection_y_coordinate", "Y");
  group.coordinate("x", x, {"m", "centre of the cell, local x (east)"}, "projection_x_coordinate", "X");

  const Group::Dimensions maps = {"transmitter", "frequency", "y", "x"};
  group.variable("path_gain", maps, map.path_gain, {gain, "path gain, mean over the cell", true},
                 {{"ancillary_variables", "standard_error bias"},
                  {"comment", "NaN: wholly inside a solid, nothing was asked; 0: asked, nothing arrived"}});
  group.variable("standard_error", maps, map.standard_error,
                 {gain, "standard error of path_gain (of the sampling, not of the model)", true});
  group.variable("bias", maps, map.bias, {gain, "estimate of the gain that the run has not found", true});
  group.variable("mechanism_gain", {"transmitter", "mechanism", "frequency", "y", "x"}, map.mechanism_gain,
                 {gain, "path gain by mechanism; adds up to path_gain", true});
  group.variable("mean_delay", maps, map.mean_delay, {"s", "mean delay, weighted by power", true});
  group.variable("rms_delay_spread", maps, map.rms_delay_spread,
                 {"s", "root mean square delay spread, weighted by power", true});
  group.variable("inside_fraction", {"y", "x"}, map.inside_fraction, {"1", "share of the cell inside solids"});
  group.variable("detection_limit", {"transmitter", "y", "x"}, map.detection_limit,
                 {gain, "path gain that the run would have found with 95 % confidence", true});
  group.close();
}

/// The paths of a receiver as tables (transmitter, path, …); places without a path hold NaN, "", or no points.
void write_paths(Group& group, const Plan& plan, const ReceiverProfile& profile) {
  const std::size_t transmitters = plan.request.transmitters.size();
  const std::size_t fields = plan.polarisations() * plan.bands();
  if (profile.paths.size() != transmitters)
    throw std::logic_error("result: paths of " + profile.name + " are not one list for each transmitter");
  std::size_t places = 0, points = 0;
  for (const auto& list : profile.paths) {
    places = std::max(places, list.size());
    for (const PathStory& path : list) points += path.points.size();
  }
  const std::size_t size = transmitters * places;
  std::vector<std::int32_t> count(transmitters), start(size), length(size, 0);
  std::vector<double> delay(size, not_a_number), real(size * fields, not_a_number), imaginary = real;
  std::vector<double> out_azimuth = delay, out_elevation = delay, in_azimuth = delay, in_elevation = delay;
  std::vector<double> xyz;
  std::vector<std::string> interactions(size), models(size);
  xyz.reserve(3 * points);
  for (std::size_t t = 0; t < transmitters; ++t) {
    count[t] = std::int32_t(profile.paths[t].size());
    for (std::size_t p = 0; p < places; ++p) {
      const std::size_t at = t * places + p;
      start[at] = std::int32_t(xyz.size() / 3);
      if (p >= profile.paths[t].size()) continue;
      const PathStory& path = profile.paths[t][p];
      if (path.amplitude.size() != fields)
        throw std::logic_error("result: a path to " + profile.name + " has " + std::to_string(path.amplitude.size()) +
                               " amplitudes instead of " + std::to_string(fields));
      for (std::size_t i = 0; i < fields; ++i) {
        real[at * fields + i] = path.amplitude[i].real();
        imaginary[at * fields + i] = path.amplitude[i].imag();
      }
      delay[at] = path.delay;
      out_azimuth[at] = path.departure_azimuth;
      out_elevation[at] = path.departure_elevation;
      in_azimuth[at] = path.arrival_azimuth;
      in_elevation[at] = path.arrival_elevation;
      interactions[at] = path.interactions;
      models[at] = path.models;
      length[at] = std::int32_t(path.points.size());
      for (const Vec3& point : path.points) xyz.insert(xyz.end(), {point.x, point.y, point.z});
    }
  }

  const bool radio = plan.request.kind == WaveKind::radio;
  const std::string field = radio ? "1" : "m-1";
  group.dimension("path", places);
  group.coordinate("polarisation", radio ? std::vector<std::string>{"V", "H"} : std::vector<std::string>{"pressure"},
                   {"", radio ? "polarisation of the receiver" : "sound has one component"});
  group.dimension("point", points);
  group.coordinate("axis", std::vector<std::string>{"x", "y", "z"}, {"", "local east, north, up"});

  const Group::Dimensions each = {"transmitter", "path"};
  const Group::Dimensions amplitude = {"transmitter", "path", "polarisation", "frequency"};
  const std::map<std::string, std::string> phase = {
      {"comment", "|amplitude|^2 = gain; the phase of the carrier exp(-j omega delay) is included"}};
  group.variable("path_count", {"transmitter"}, count, {"1", "number of paths listed, strongest first"});
  group.variable("path_delay", each, delay, {"s", "delay of the path", true});
  group.variable("path_amplitude_re", amplitude, real, {field, "amplitude of the path, real part", true}, phase);
  group.variable("path_amplitude_im", amplitude, imaginary, {field, "amplitude of the path, imaginary part", true},
                 phase);
  group.variable("departure_azimuth", each, out_azimuth,
                 {"degree", "azimuth at the transmitter, clockwise from north (+y)", true});
  group.variable("departure_elevation", each, out_elevation, {"degree", "elevation at the transmitter", true});
  group.variable("arrival_azimuth", each, in_azimuth,
                 {"degree", "azimuth at the receiver, clockwise from north (+y)", true});
  group.variable("arrival_elevation", each, in_elevation, {"degree", "elevation at the receiver", true});
  group.variable("path_interactions", each, interactions,
                 {"", "interactions from the transmitter on: R:material, T:material, S:material, D:edge"});
  group.variable("path_models", each, models,
                 {"", "model with the largest share in the wave of each edge: utd, fsd, fsd-polygon"});
  group.variable("point_xyz", {"point", "axis"}, xyz, {"m", "points of the paths, transmitter to receiver"});
  group.variable("path_point_start", each, start, {"1", "first point of the path in point_xyz"});
  group.variable("path_point_count", each, length, {"1", "number of points of the path"},
                 {{"sample_dimension", "point"}});
}

void write_profile(hid_t parent, const Plan& plan, const ReceiverProfile& profile) {
  const bool radio = plan.request.kind == WaveKind::radio;
  const std::string gain = radio ? "1" : "m-2";
  Group group(parent, profile.name);
  set_numbers(group, "position", H5T_NATIVE_DOUBLE, 3,
              std::vector<double>{profile.position.x, profile.position.y, profile.position.z}.data());
  for (const Receiver& receiver : plan.request.receivers)
    if (radio && receiver.name == profile.name)
      set_text(group, "polarisation", polarisation_name(receiver.polarisation));
  write_common_coordinates(group, plan);
  group.coordinate("delay", profile.delay, {"s", "delay after departure, centre of the bin"});
  const Group::Dimensions each = {"transmitter", "frequency"};
  group.variable("power", {"transmitter", "frequency", "delay"}, profile.power, {gain, "path gain in the bin"});
  group.variable("total", each, profile.total, {gain, "path gain, composites added as powers"});
  group.variable("total_coherent", each, profile.total_coherent, {gain, "path gain, all arrivals added as fields"});
  group.variable("total_completed", each, profile.total_completed,
                 {gain, "path gain, all arrivals added as fields, edges beyond the depth estimated"});
  group.variable("mean_delay", each, profile.mean_delay, {"s", "mean delay, weighted by power", true});
  group.variable("rms_delay_spread", each, profile.rms_delay_spread,
                 {"s", "root mean square delay spread, weighted by power", true});
  write_paths(group, plan, profile);
  group.close();
}

/// Receivers become names of groups: "." would be HDF5's own name for the group around it, and a name can be had once.
void check_names(const std::vector<ReceiverProfile>& profiles) {
  Diagnostics faults;
  std::set<std::string> seen;
  for (const ReceiverProfile& profile : profiles) {
    if (profile.name.empty() || profile.name == "." || profile.name.find('/') != std::string::npos)
      faults.error({}, 0, "receiver.name", "\"" + profile.name + "\" cannot name a receiver",
                   "it becomes the name of a group in result.h5", "use letters, digits, _ . -");
    else if (!seen.insert(profile.name).second)
      faults.error({}, 0, "receiver.name", "two receivers are called \"" + profile.name + "\"",
                   "each becomes a group in result.h5", "give each a name of its own");
  }
  faults.throw_if_errors();
}

}  // namespace

void write_result(const std::filesystem::path& file, const Scene& scene, const Plan& plan, const Result& result,
                  const std::string& program_version) {
  check_names(result.profiles);
  // After a full disk HDF5 would try again to flush when the program ends, and complain in its own words.
  H5dont_atexit();
  const QuietHdf quiet;
  PartialFile partial(file);
  try {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
    // Nobody else knows the temporary name, and some network file systems refuse locks.
    checked(H5Pset_file_locking(access, false, true));
    Handle output(H5Fcreate(partial.name().c_str(), H5F_ACC_TRUNC, group_creation(H5P_FILE_CREATE), access), H5Fclose);
    write_root(output, scene, plan, result, program_version);
    if (result.coverage) write_coverage(output, plan, *result.coverage);
    if (!result.profiles.empty()) {
      Group profiles(output, "profile");
      for (const ReceiverProfile& profile : result.profiles) write_profile(profiles, plan, profile);
      profiles.close();
    }
    checked(H5Fflush(output, H5F_SCOPE_GLOBAL));
    output.close();
  } catch (const HdfFailure& failure) {
    partial.fail(failure.what());
  }
  partial.commit();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  PartialFile partial(file);
  errno = 0;
  std::ofstream output(partial.name(), std::ios::binary);
  output << text;
  output.close();
  if (!output) partial.fail(errno != 0 ? std::strerror(errno) : "the text was not written whole");
  partial.commit();
}

}  // namespace grimaldi
