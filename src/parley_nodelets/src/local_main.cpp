// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/local_node.h"
#include "parley_nodelets/run_node.h"

int main(int argc, char** argv) { return parley::runNode<parley::LocalNode>(argc, argv, "local"); }
