//! From device memory to arrays. Submits and waits: not for the host's way.

use crate::errors::lost;
use crate::externals::Bound;
use crate::pool::Part;

use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::Problem;

/// Largest staging buffer, bytes: larger values travel in pieces of this size.
const PIECE_BYTES: u64 = 64 << 20;

/// The value of `part` as an array of `element`.
pub(crate) fn read_part(bound: &Bound, queue: &wgpu::Queue, part: &Part, element: Element) -> Result<Array, Problem> {
    let device = &bound.prepared.device;
    let words = match part.storage {
        Storage::Buffer => {
            let (buffer, offset) = bound.buffer(part);
            read_words(device, queue, buffer, offset, part.words())?
        }
        _ if part.words() == 0 => Vec::new(),
        _ => read_texture(device, queue, bound.texture(part), part)?,
    };
    Ok(Array::from_words(element, part.shape.clone(), words))
}

/// `count` words of `buffer` from byte `offset`.
///
/// # Errors
/// The device is lost or out of memory.
pub fn read_words(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    buffer: &wgpu::Buffer,
    offset: u64,
    count: usize,
) -> Result<Vec<u32>, Problem> {
    let mut words = Vec::with_capacity(count);
    let piece = PIECE_BYTES.min(device.limits().max_buffer_size);
    while words.len() < count {
        let bytes = ((count - words.len()) as u64 * 4).min(piece);
        let start = offset + words.len() as u64 * 4;
        staged(
            device,
            queue,
            bytes,
            |encoder, staging| {
                encoder.copy_buffer_to_buffer(buffer, start, staging, 0, bytes);
            },
            |mapped| words.extend_from_slice(bytemuck::cast_slice(mapped)),
        )?;
    }
    Ok(words)
}

/// All texels, layer by layer. Rows travel padded to 256 bytes.
fn read_texture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
    part: &Part,
) -> Result<Vec<u32>, Problem> {
    let [width, height, layers] = part.extent();
    let row_words = width as usize * if part.storage == Storage::Rgba32Float { 4 } else { 1 };
    let row_bytes = (row_words as u32 * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    // Depth can only be copied a whole layer at a time.
    let whole = part.storage == Storage::DepthTexture;
    let rows_at_once = if whole { height } else { (PIECE_BYTES / u64::from(row_bytes)).clamp(1, height.into()) as u32 };
    let mut words = Vec::with_capacity(part.words());
    for layer in 0..layers {
        for row in (0..height).step_by(rows_at_once as usize) {
            let rows = rows_at_once.min(height - row);
            let bytes = u64::from(row_bytes) * u64::from(rows);
            let record = |encoder: &mut wgpu::CommandEncoder, staging: &wgpu::Buffer| {
                let origin = wgpu::Origin3d { x: 0, y: row, z: layer };
                encoder.copy_texture_to_buffer(
                    wgpu::TexelCopyTextureInfo { texture, mip_level: 0, origin, aspect: wgpu::TextureAspect::All },
                    wgpu::TexelCopyBufferInfo {
                        buffer: staging,
                        layout: wgpu::TexelCopyBufferLayout {
                            offset: 0,
                            bytes_per_row: Some(row_bytes),
                            rows_per_image: Some(rows),
                        },
                    },
                    wgpu::Extent3d { width, height: rows, depth_or_array_layers: 1 },
                );
            };
            staged(device, queue, bytes, record, |mapped| {
                for row in mapped.chunks_exact(row_bytes as usize) {
                    words.extend_from_slice(bytemuck::cast_slice(&row[..row_words * 4]));
                }
            })?;
        }
    }
    Ok(words)
}

/// Records a copy into a staging buffer, submits it, waits, and shows the bytes.
fn staged(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    bytes: u64,
    record: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
    show: impl FnOnce(&[u8]),
) -> Result<(), Problem> {
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: bytes,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("readback") });
    record(&mut encoder, &staging);
    let submission = queue.submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |_| {});
    wait(device, Some(submission))?;
    match staging.get_mapped_range(..) {
        Ok(mapped) => show(&mapped),
        Err(error) => return Err(lost(&error.to_string())),
    }
    staging.unmap();
    Ok(())
}

/// Waits until the device has done what was submitted.
///
/// # Errors
/// The device is lost.
pub fn wait(device: &wgpu::Device, submission_index: Option<wgpu::SubmissionIndex>) -> Result<(), Problem> {
    let poll = wgpu::PollType::Wait { submission_index, timeout: None };
    device.poll(poll).map(|_| ()).map_err(|error| lost(&error.to_string()))
}
