// extension -> its panels, as a function of its contents, unpacked, and of what the page offers; each has a title, `draw`, and what it
// shows of the state; `first`: a table above all others
const panels = {};
