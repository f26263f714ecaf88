//! Ground made of pieces is one ground: what slides or rolls over it does not feel where the pieces meet.

mod chains;
mod edges;
mod lines;
mod pieces;
mod seams;
mod tiles;
mod union;
