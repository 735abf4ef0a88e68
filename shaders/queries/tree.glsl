// The tree over a group's pieces. Node 1 is the root, node n has the children 2 n and 2 n + 1, and the leaves are the nodes from
// pieceCount on. Which piece a leaf is no pose changes; boxes are those of the pose. Needs queries.glsl.
//
// Two vec4 a node: low corner, high corner. Beside the low corner a leaf has the number of its piece. An inner node has what tells the
// child that comes first along a ray (kTreeAxis, kTreeTurned).

// Where the nodes of an instance begin: the place-th of those that have trees.
uint firstNode(uint place) { return 2u * push.pieceCount * place; }
// The instance with that tree, in the list of the window.
uint listedInTree(uint place) { return boxWords.at[2u * (push.firstBox + push.turn * push.treeCount + place) + 1u].w; }
// How many instances have trees.
uint treesOfTurn() { return boxWords.at[push.firstDispatch + 1u + kTreeDispatches * push.turn].w; }

const uint kTreeAxis = 3u;   // along which the children lie apart
const uint kTreeTurned = 4u; // the second child lies below the first
