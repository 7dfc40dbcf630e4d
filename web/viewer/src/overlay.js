// SPDX-License-Identifier: Apache-2.0
//
// Marks over a picture that takes long: they come and go while what is below is kept.

import * as THREE from 'three';

export class Overlay {
  /** The renderer keeps its buffers; marks do not write depth. */
  constructor(renderer) {
    this.renderer = renderer;
    this.scene = new THREE.Scene();
    this.kept = null;
    this.restore = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2),
      new THREE.ShaderMaterial({
        uniforms: { kept: { value: null } },
        vertexShader: 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
        fragmentShader:
          'uniform sampler2D kept; void main() { gl_FragColor = texelFetch(kept, ivec2(gl_FragCoord.xy), 0); }',
        blending: THREE.NoBlending, depthTest: false, depthWrite: false,
      }),
    );
    this.restore.frustumCulled = false;
    this.restore.renderOrder = -1;
    this.scene.add(this.restore);
  }

  /** Copies what has just been drawn. */
  keep() {
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    if (!this.kept || this.kept.image.width !== size.x || this.kept.image.height !== size.y) {
      this.kept?.dispose();
      this.kept = new THREE.FramebufferTexture(size.x, size.y);
      this.restore.material.uniforms.kept.value = this.kept;
    }
    this.renderer.copyFramebufferToTexture(this.kept);
  }

  /** All marks; `again`: in place of those that are there. */
  render(camera, again) {
    this.restore.visible = again;
    this.renderer.render(this.scene, camera);
  }
}
