// The place of a row in a table of lists, as table_fill.rs has it. Joined after the prelude.

struct TableSize {
    // Rows.
    rows: u32,
    // Cells: one offset each, then the total.
    cells: u32,
    // Words of the table.
    capacity: u32,
}

@group(0) @binding(0) var<uniform> size: TableSize;
@group(0) @binding(1) var<storage, read> cell: array<u32>;
@group(0) @binding(2) var<storage, read> slot: array<u32>;
@group(0) @binding(3) var<storage, read> offset: array<u32>;

const NO_PLACE: u32 = 0xffffffffu;

// None for a row in no list, and past the capacity.
fn table_place(row: u32) -> u32 {
    let own = cell[row];
    if own >= size.cells {
        return NO_PLACE;
    }
    let place = offset[own] + slot[row];
    return select(NO_PLACE, place, place < size.capacity);
}
