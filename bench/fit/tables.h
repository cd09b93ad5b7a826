#pragma once

#include <map>
#include <string>
#include <vector>

#include "fit/methods.h"
#include "table.h"

namespace quadrille::bench {

/// Where a row keeps the figures of a run, as a JSON pointer: /QUADS/MESH/FIT.
std::string place_of(const FitRun& run);

/// The rows by their member `preset`; those without it are left out.
std::map<std::string, std::vector<TableRow>> by_preset(const std::vector<TableRow>& rows);

/// Per number of quads: MAE, PSNR and SSIM of every run, a line per picture.
void print_quality(const std::string& of, const std::vector<FitRun>& runs,
                   const std::vector<TableRow>& rows);

/// A line per run with the means over the pictures: quality, scalars, bytes, the JPEG of equal
/// size, CPU seconds; and where the mesh is worse than the lattice with the same fit and wished
/// count.
void print_means(const std::string& of, const std::vector<FitRun>& runs,
                 const std::vector<TableRow>& rows);

/// The rows' member `upscale`.
void print_upscale(const std::string& of, const std::vector<TableRow>& rows);

/// Rows of iterations_with_size().
void print_size_growth(const std::string& of, const std::vector<TableRow>& rows);

}  // namespace quadrille::bench
