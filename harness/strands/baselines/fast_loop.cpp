#define LOOP_SPACE fast
#include "harness/strands/baselines/serial_loop.inl"

namespace pelage::strands {

const SerialLoop fast_chain_loop = fast::advance;

}  // namespace pelage::strands
