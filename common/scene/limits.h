#pragma once

#include <cstddef>
#include <cstdint>

/// What a scene may hold. Each bound has its reason; larger is an error that names the bound.
namespace metamer::limits {

inline constexpr std::uint32_t max_side = 16384;            ///< Pixels; the largest GL texture.
inline constexpr std::uint64_t max_pixels = 256u << 20;     ///< A square of them: 3 GiB of XYZ.
inline constexpr std::uint64_t max_view_pixels = 4u << 20;  ///< 12 MiB a frame; 2560 × 1600.
inline constexpr std::uint32_t max_spp = 1024;              ///< A minute a tile is not a preview.
inline constexpr std::uint32_t max_depth = 64;  ///< 0.9⁶⁴ = 0.1 %: nothing more to see.
inline constexpr std::uint32_t max_light_samples = 256;  ///< As many again as max_spp allows.
inline constexpr std::uint32_t max_bounces = 16;  ///< 0.8¹⁶ = 3 % of a white room's light is left.
inline constexpr std::uint32_t max_bounce_samples = 256;  ///< As of lights.
inline constexpr std::uint32_t max_paths =
    16384;  ///< A pixel: 0.8 % of noise where one is 100 % off.
inline constexpr std::uint32_t max_threads = 256;
inline constexpr std::uint32_t max_bases = 16;   ///< Beyond, point sampling is cheaper and exact.
inline constexpr std::uint32_t max_fitted = 64;  ///< Beyond, uniform wavelengths do as well.
inline constexpr std::uint32_t max_tile = 256;   ///< 768 KiB of XYZ: one frame.
inline constexpr std::size_t max_lights = 256;   ///< Each costs a shadow ray per sample.
inline constexpr double max_exposure = 30;       ///< Stops, up or down; below, f32 still has all.
inline constexpr double min_luminance = 1e-30;   ///< Products with it are still whole in f32,
inline constexpr double max_luminance = 1e30;    ///< and these finite.
inline constexpr double min_cutoff = 1e-6;       ///< Of a sample's paths at most 1e6 are alive.
inline constexpr double min_thickness = 1e-9;    ///< metres, of a measured transmittance.
inline constexpr double max_thickness = 1e9;
inline constexpr int max_priority = 1'000'000;
inline constexpr std::size_t max_interfaces = 64;   ///< × 1,024 rows of a method's tables.
inline constexpr std::size_t max_materials = 4096;  ///< × 2 spectra × 4,001 × 4 B = 131 MB.
inline constexpr int max_texture_spectra = 32;      ///< A press has 8 inks, a palette a few more.
/// Pixels × spectra of a texture's picture: 128 MiB, and a third more with its smaller copies.
inline constexpr std::uint64_t max_texture_weights = 64u << 20;
inline constexpr double max_map_strength = 1e6;  ///< Metres, or upright normals turned flat.
/// Emissions × fluorescences; each is a spectrum that every thread of a reference has in f64.
inline constexpr std::size_t max_reradiated = 1024;
inline constexpr std::size_t max_objects = 100'000;
inline constexpr std::size_t max_looks = 1000;        ///< People choose one from a list.
inline constexpr std::size_t max_name = 200;          ///< Characters; they are for people.
inline constexpr std::size_t max_text = 4096;         ///< Bytes; Linux's longest path.
inline constexpr std::size_t max_transforms = 64;     ///< Steps of one object's placement.
inline constexpr double min_wavelength = 1;           ///< nm; spectra and positions lie in
inline constexpr double max_wavelength = 10'000;      ///< 1 nm to 10 µm; eyes see 360 to 830.
inline constexpr int max_lines = 256;                 ///< Of a lamp; mercury has 50 that are seen.
inline constexpr double max_coordinate = 1e15;        ///< Embree aborts beyond 1.8e18.
inline constexpr std::uint64_t max_asset = 1u << 30;  ///< Ten million triangles as PLY.
/// Files of a scene: with names of 200 bytes and their digests they are 240 KiB, a control message.
inline constexpr std::size_t max_assets = 1024;
inline constexpr std::uint64_t max_triangles = 50'000'000;  ///< 8 GB of BVH.

}  // namespace metamer::limits
