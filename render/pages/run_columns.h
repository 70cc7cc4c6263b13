// The main figures of the runs of a batch, as columns of its page: what was swept, what tore, into what, with
// which energy, and whether answers hold.
#pragma once

#include "render/pages/batch_page.h"
#include "render/report/page.h"

namespace rend {

std::vector<html::TableColumn> run_columns(const BatchReport& report);
std::vector<html::TableCell> run_cells(const BatchReport& report,
                                       std::size_t job); // one per column; a dash: unknown

} // namespace rend
