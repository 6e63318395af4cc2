#include "tools/picture/coarse_layers.h"

namespace talus {

template <int Dim>
Pile<Dim> with_coarse_layers(Pile<Dim> pile, int most) {
  const std::size_t together = (pile.layers.size() + most - 1) / most;
  std::vector<Layer> coarse;
  for (std::size_t i = 0; i < pile.layers.size(); ++i) {
    const Layer& fine = pile.layers[i];
    if (i % together == 0) {
      coarse.push_back(fine);
      continue;
    }
    Layer& layer = coarse.back();
    layer.top = fine.top;
    layer.volume += fine.volume;
    layer.capacity += fine.capacity;
    layer.count += fine.count;
    layer.sleeping += fine.sleeping;
  }
  pile.layers = std::move(coarse);
  return pile;
}

template Pile<2> with_coarse_layers(Pile<2>, int);
template Pile<3> with_coarse_layers(Pile<3>, int);

}  // namespace talus
