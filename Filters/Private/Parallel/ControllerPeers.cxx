// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Parallel/ControllerPeers.h"

#include "vtkCommunicator.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace vtkIsodiamond
{
namespace
{

/** In parts, so that no process needs memory that another may lack, and counts fit in 32 bits. */
template <typename T>
void Reduce(vtkMultiProcessController* controller, T* values, std::int64_t count, int operation)
{
  constexpr std::int64_t part = 1 << 13;
  std::array<T, part> result;
  for (std::int64_t first = 0; first < count; first += part)
  {
    const std::int64_t size = std::min(part, count - first);
    if (!controller->AllReduce(values + first, result.data(), size, operation))
    {
      throw std::runtime_error("The processes that work together cannot reach each other.");
    }
    std::copy_n(result.begin(), size, values + first);
  }
}

}

int ControllerPeers::CountOf(vtkInformation* outputInformation)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool isOneOfMany = controller && outputInformation &&
    outputInformation->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) ==
      controller->GetNumberOfProcesses() &&
    outputInformation->Get(Pipeline::UPDATE_PIECE_NUMBER()) == controller->GetLocalProcessId();
  return isOneOfMany ? controller->GetNumberOfProcesses() : 1;
}

ControllerPeers::ControllerPeers()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

int ControllerPeers::Count() const
{
  return this->Controller->GetNumberOfProcesses();
}

int ControllerPeers::Rank() const
{
  return this->Controller->GetLocalProcessId();
}

void ControllerPeers::Or(std::uint8_t* bytes, std::int64_t count)
{
  Reduce(this->Controller, bytes, count, vtkCommunicator::BITWISE_OR_OP);
}

void ControllerPeers::Max(std::uint16_t* values, std::int64_t count)
{
  Reduce(this->Controller, values, count, vtkCommunicator::MAX_OP);
}

void ControllerPeers::Max(double* values, std::int64_t count)
{
  Reduce(this->Controller, values, count, vtkCommunicator::MAX_OP);
}

}
